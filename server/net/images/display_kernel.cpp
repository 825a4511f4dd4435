#include "server/net/images/display_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "server/net/images/display_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace relume::net::HWY_NAMESPACE {

std::size_t codes_of_vectors(const DisplayBins& bins,
                             const float* HWY_RESTRICT linear,
                             std::size_t count,
                             std::uint8_t* HWY_RESTRICT codes) {
#if HWY_TARGET == HWY_SCALAR
    (void)bins, (void)linear, (void)count, (void)codes;
    return 0;
#else
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::ScalableTag<float> df;
    const hn::RebindToSigned<decltype(df)> di;
    const hn::Rebind<std::uint8_t, decltype(df)> d8;
    const auto* entries = reinterpret_cast<const std::int32_t*>(bins.entries);
    const auto first_bin = hn::Set(di, static_cast<std::int32_t>(bins.first_bin));
    const auto last = hn::Set(di, static_cast<std::int32_t>(DisplayBins::kBins - 1));
    const auto lower = hn::Set(di, static_cast<std::int32_t>(DisplayBins::kLowerBits));
    const auto zero = hn::Zero(di);
    std::size_t i = 0;
    for (; i + hn::Lanes(df) <= count; i += hn::Lanes(df)) {
        const auto value = hn::LoadU(df, linear + i);
        const auto bits = hn::BitCast(di, value);
        const auto bin = hn::Sub(hn::ShiftRight<DisplayBins::kBinShift>(bits), first_bin);
        const auto entry = hn::GatherIndex(di, entries, hn::Min(hn::Max(bin, zero), last));
        const auto code =
            hn::ShiftRight<DisplayBins::kBinShift>(hn::Add(entry, hn::And(bits, lower)));
        // NaN and all up to 0 have the code of 0.
        const auto positive = hn::RebindMask(di, hn::Gt(value, hn::Zero(df)));
        hn::StoreU(hn::DemoteTo(d8, hn::IfThenElseZero(positive, code)), d8, codes + i);
    }
    return i;
#endif
}

}  // namespace relume::net::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relume::net {

HWY_EXPORT(codes_of_vectors);

std::size_t write_vectors_of_codes(const DisplayBins& bins,
                                   const float* linear,
                                   std::size_t count,
                                   std::uint8_t* codes) {
    return HWY_DYNAMIC_DISPATCH(codes_of_vectors)(bins, linear, count, codes);
}

}  // namespace relume::net
#endif  // HWY_ONCE
