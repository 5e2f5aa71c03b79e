#pragma once
// How long a span between two marks of the device's clock must be for its time to mean something, and what is filled
// before a cold one.

#include <cstdint>

namespace clusterbench::gpu {

// Filled before cold work, so that no cache holds what it reads. Less on software devices, whose caches are the
// processor's.
inline constexpr std::uint64_t k_flushed_bytes = std::uint64_t{256} << 20,
                               k_flushed_bytes_of_software = std::uint64_t{32} << 20;
// Slower than most devices fill memory.
inline constexpr double k_flushed_bytes_per_ns = 20.0;
// Devices are asked to do no more at a time, if they can do one frame's work in it.
inline constexpr double k_longest_submit_ns = 1e8;

// 1,000 periods of the device's clock, and 20 us, since some clocks count in steps of many periods.
double least_span_ns(double timestamp_period_ns);

// How often work that takes `once_ns` is repeated in a span: until it lasts least_span_ns(), but no longer than
// `longest_ns`. At least 1.
std::uint32_t repeats_for(double once_ns, double timestamp_period_ns, double longest_ns);
// The same for cold work, where so many bytes are filled before each repetition, which has a span of its own: all of
// them together last as long, if they fit in a submission and its marks.
std::uint32_t cold_repeats_for(double once_ns, double timestamp_period_ns, std::uint64_t flushed_bytes);

}  // namespace clusterbench::gpu
