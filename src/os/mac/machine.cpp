#include "os/machine.h"

#include <stdlib.h>
#include <sys/sysctl.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <thread>

namespace clusterbench::os {
namespace {

// A fact of sysctl(3); `otherwise` where this machine has none of that name.
template <class Number>
Number fact(const char* name, Number otherwise) {
  Number value{};
  std::size_t bytes = sizeof value;
  return ::sysctlbyname(name, &value, &bytes, nullptr, 0) == 0 && bytes == sizeof value ? value : otherwise;
}

std::string text_fact(const char* name) {
  std::array<char, 256> text{};
  std::size_t bytes = text.size() - 1;
  return ::sysctlbyname(name, text.data(), &bytes, nullptr, 0) == 0 ? std::string(text.data()) : std::string();
}

// Of Intel's processors; Apple's have none.
std::string number_fact(const char* name) {
  const std::int32_t value = fact<std::int32_t>(name, -1);
  return value < 0 ? "" : std::to_string(value);
}

}  // namespace

Machine this_machine() {
  Machine machine;
  const std::string brand = text_fact("machdep.cpu.brand_string");
  machine.processor = {brand.empty() ? "unknown" : brand, number_fact("machdep.cpu.family"),
                       number_fact("machdep.cpu.model"), number_fact("machdep.cpu.stepping")};
  machine.caches = caches_now();
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  machine.ram_bytes = fact<std::uint64_t>("hw.memsize", 0);
  utsname names{};
  if (uname(&names) == 0) machine.system = std::string(names.sysname) + " " + names.release + " " + names.machine;
  return machine;
}

std::vector<std::pair<std::string, std::uint64_t>> caches_now() {
  std::vector<std::pair<std::string, std::uint64_t>> caches;
  constexpr std::array<std::pair<const char*, const char*>, 4> k_facts{
      {{"l1d", "hw.l1dcachesize"}, {"l1i", "hw.l1icachesize"}, {"l2", "hw.l2cachesize"}, {"l3", "hw.l3cachesize"}}};
  for (const auto& [name, of] : k_facts)
    if (const std::uint64_t bytes = fact<std::uint64_t>(of, 0); bytes > 0) caches.emplace_back(name, bytes);
  return caches;
}

// No call of macOS tells it to programs of users.
std::optional<Clock> clock_now() {
  return std::nullopt;
}

std::optional<double> load_now() {
  double minute = 0.0;
  return ::getloadavg(&minute, 1) == 1 ? std::optional(minute) : std::nullopt;
}

}  // namespace clusterbench::os
