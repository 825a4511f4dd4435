// What a connection needs of the server; all of it outlives all connections.
#pragma once

#include "protocol/wire/limits.h"
#include "server/net/access.h"
#include "server/net/client_address.h"
#include "server/net/connection_options.h"
#include "server/net/http_routes.h"
#include "server/net/metrics.h"
#include "server/net/readiness.h"
#include "server/net/rooms.h"
#include "server/net/upload.h"

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
