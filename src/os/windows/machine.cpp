#include "os/machine.h"

#include <algorithm>
#include <array>
#include <thread>

#include "os/windows/windows_api.h"

#if defined(__x86_64__) || defined(_M_X64)
#ifdef _MSC_VER
#include <intrin.h>
#else
#include <cpuid.h>
#endif
#endif

namespace clusterbench::os {
namespace {

constexpr const wchar_t* k_processor_key = L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0";

std::string registry_text(const wchar_t* name) {
  std::array<wchar_t, 256> text{};
  DWORD bytes = sizeof text;
  if (::RegGetValueW(HKEY_LOCAL_MACHINE, k_processor_key, name, RRF_RT_REG_SZ, nullptr, text.data(), &bytes) != 0)
    return "";
  std::string value = narrow(text.data());
  while (!value.empty() && value.back() == ' ') value.pop_back();
  return value;
}

#if defined(__x86_64__) || defined(_M_X64)
std::uint32_t cpuid_signature() {
#ifdef _MSC_VER
  int registers[4]{};
  __cpuid(registers, 1);
  return static_cast<std::uint32_t>(registers[0]);
#else
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 ? a : 0;
#endif
}

// As the vendors' manuals put them together (CPUID leaf 1), and as Linux prints them.
void add_numbers(Processor& processor) {
  const std::uint32_t bits = cpuid_signature();
  const std::uint32_t base = bits >> 8 & 15;
  const std::uint32_t family = base == 15 ? base + (bits >> 20 & 255) : base;
  const std::uint32_t model = (bits >> 4 & 15) | (base == 6 || base == 15 ? (bits >> 16 & 15) << 4 : 0);
  processor.family = std::to_string(family);
  processor.model = std::to_string(model);
  processor.stepping = std::to_string(bits & 15);
}
#else
void add_numbers(Processor&) {}
#endif

Processor this_processor() {
  Processor processor;
  processor.name = registry_text(L"ProcessorNameString");
  if (processor.name.empty()) processor.name = "unknown";
  add_numbers(processor);
  return processor;
}

const char* ending_of(PROCESSOR_CACHE_TYPE type) {
  return type == CacheData ? "d" : type == CacheInstruction ? "i" : "";
}

// Programs that do not say for which Windows they are made are told an old version; this call tells the true one.
std::string system_text() {
  using GetVersion = LONG(WINAPI*)(OSVERSIONINFOW*);
  OSVERSIONINFOW facts{};
  facts.dwOSVersionInfoSize = sizeof facts;
  const HMODULE library = ::GetModuleHandleW(L"ntdll.dll");
  const auto get =
      library == nullptr
          ? nullptr
          : reinterpret_cast<GetVersion>(reinterpret_cast<void*>(::GetProcAddress(library, "RtlGetVersion")));
  if (get == nullptr || get(&facts) != 0) return "Windows";
  return "Windows " + std::to_string(facts.dwMajorVersion) + "." + std::to_string(facts.dwMinorVersion) + "." +
         std::to_string(facts.dwBuildNumber) +
#if defined(__aarch64__) || defined(_M_ARM64)
         " arm64";
#else
         " x86_64";
#endif
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.processor = this_processor();
  machine.caches = caches_now();
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  MEMORYSTATUSEX memory{};
  memory.dwLength = sizeof memory;
  if (::GlobalMemoryStatusEx(&memory) != 0) machine.ram_bytes = memory.ullTotalPhys;
  machine.system = system_text();
  return machine;
}

std::vector<std::pair<std::string, std::uint64_t>> caches_now() {
  DWORD bytes = 0;
  ::GetLogicalProcessorInformationEx(RelationCache, nullptr, &bytes);
  std::vector<char> facts(bytes);
  auto* const first = reinterpret_cast<SYSTEM_LOGICAL_PROCESSOR_INFORMATION_EX*>(facts.data());
  if (bytes == 0 || ::GetLogicalProcessorInformationEx(RelationCache, first, &bytes) == 0) return {};
  std::vector<std::pair<std::string, std::uint64_t>> caches;
  for (DWORD at = 0; at < bytes;) {
    const auto& one = *reinterpret_cast<SYSTEM_LOGICAL_PROCESSOR_INFORMATION_EX*>(facts.data() + at);
    const CACHE_RELATIONSHIP& cache = one.Cache;
    if ((cache.GroupMask.Mask & 1) != 0 && cache.GroupMask.Group == 0)
      caches.emplace_back("l" + std::to_string(cache.Level) + ending_of(cache.Type), cache.CacheSize);
    at += one.Size;
  }
  std::ranges::sort(caches);
  return caches;
}

// Windows tells programs the clock that the processor is sold with, and not the one that it has.
std::optional<Clock> clock_now() {
  return std::nullopt;
}

// Windows counts no waiting processes.
std::optional<double> load_now() {
  return std::nullopt;
}

}  // namespace clusterbench::os
