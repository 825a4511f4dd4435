// By which method and in which order changed coefficients reach the image.
#pragma once

#include "protocol/base/text/name_table.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace relume::relighting {

// What happens to the approximation when the signal changes: README of server/engine.
//   nwa      begins anew with every image              [Ng03]
//   bi       is kept                                   [Overbeck06 §3]
//   pbi      is kept or begins anew, band by band      [Overbeck06 §5]
//   guarded  pbi, whose resets are taken only where they make the image's error smaller
enum class Method : std::uint8_t { nwa, bi, pbi, guarded };

// What a coefficient's change is weighted with to rank it: ColumnTable::weights.
enum class Priority : std::uint8_t { area, none, transport, benefit };
inline constexpr std::size_t kPriorityCount = 4;

inline constexpr text::NameTable<Method, 4> kMethodNames({{
    {Method::nwa, "nwa"},
    {Method::bi, "bi"},
    {Method::pbi, "pbi"},
    {Method::guarded, "guarded"},
}});

inline constexpr text::NameTable<Priority, kPriorityCount> kPriorityNames({{
    {Priority::area, "area"},
    {Priority::none, "none"},
    {Priority::transport, "transport"},
    {Priority::benefit, "benefit"},
}});

[[nodiscard]] std::string_view name_from(Method method);
[[nodiscard]] std::string_view name_from(Priority priority);

struct Strategy {
    Method method = Method::guarded;
    Priority priority = Priority::benefit;

    friend bool operator==(const Strategy&, const Strategy&) = default;
};

}  // namespace relume::relighting
