// What a connection needs of the server; all of it outlives all connections.
#pragma once

#include "protocol/wire/limits.h"
#include "server/net/base/metrics.h"
#include "server/net/base/readiness.h"
#include "server/net/http/access.h"
#include "server/net/http/http_routes.h"
#include "server/net/http/upload.h"
#include "server/net/peers/client_address.h"
#include "server/net/rooms/rooms.h"
#include "server/net/sockets/connection_options.h"

#include <boost/asio/thread_pool.hpp>

namespace relume::net {

struct ConnectionServices {
    HttpRoutes& routes;
    Uploads& uploads;
    Rooms& rooms;
    const Access& access;
    const TrustedProxies& proxies;
    const Readiness& readiness;
    Metrics& metrics;
    const wire::Limits& limits;
    const ConnectionOptions& options;
    boost::asio::thread_pool& slow_requests;  // for answers that take long
};

}  // namespace relume::net
