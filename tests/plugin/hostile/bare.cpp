// Methods on the C header alone, in C++, without the care of clusterbench_plugin.hpp: each does what its name says, and
// otherwise nothing. They run only where they are named.

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "clusterbench_plugin.h"

namespace {

std::string_view name_of(void* instance) {
  return static_cast<const clusterbench_method*>(instance)->name;
}

clusterbench_status create(const clusterbench_method* method, const clusterbench_value* values, uint32_t value_count,
                           void** instance, clusterbench_error* error) {
#ifdef CREATE_THROWS
  throw std::runtime_error("no table");
#endif
  *instance = const_cast<clusterbench_method*>(method);
  return clusterbench_check_values(method, values, value_count, error);
}

clusterbench_status build(void* instance, const clusterbench_grid* grid, uint32_t, clusterbench_error*) {
  if (name_of(instance) == "throws-in-build") throw 42;
  if (name_of(instance) == "writes-struct") const_cast<clusterbench_grid*>(grid)->cell_count = 1;
  return CLUSTERBENCH_OK;
}

// What changes the process.
void change_surroundings(std::string_view what) {
  if (what == "sets-variable") ::setenv("LC_MESSAGES", "xx", 1);
  if (what == "masks-files") ::umask(0);
  if (what == "limits-files") {
    const rlimit limit{64, 64};
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
  if (what == "blocks-signals") {
    sigset_t some;
    sigemptyset(&some);
    sigaddset(&some, SIGALRM);
    ::sigprocmask(SIG_BLOCK, &some, nullptr);
  }
  if (what == "is-nice") ::setpriority(PRIO_PROCESS, 0, 19);
}

// Beside the standard streams.
void change_files(std::string_view what) {
  for (int file = 3; file < 20; ++file) {
    if (what == "cuts-files" && ::ftruncate(file, 0) != 0) continue;
    if (what == "writes-to-files" && ::write(file, "JUNK\n", 5) != 5) continue;
  }
}

clusterbench_status assign(void* instance, const clusterbench_frame*, const clusterbench_lights*,
                           clusterbench_lists* out, clusterbench_error*) {
  const std::string_view what = name_of(instance);
  if (what == "throws") throw std::out_of_range("vector::_M_range_check");
  if (what == "throws-bytes") throw std::runtime_error("a\xff\n\x1b[31mb");
  change_surroundings(what);
  change_files(what);
#if defined(__x86_64__)
  if (what == "leaves-mmx") asm volatile("pxor %mm0, %mm0");
#endif
  for (uint32_t cell = 0; cell <= out->cell_count; ++cell) out->begin[cell] = 0;
  return CLUSTERBENCH_OK;
}

void destroy(void*) {
#ifdef DESTROY_THROWS
  throw std::runtime_error("no end");
#endif
}

constexpr clusterbench_method named(const char* name) {
  return {sizeof(clusterbench_method),
          CLUSTERBENCH_FRUSTUM,
          CLUSTERBENCH_POINTS | CLUSTERBENCH_SPOTS,
          0,
          CLUSTERBENCH_CONSERVATIVE | CLUSTERBENCH_BY_NAME,
          0,
          name,
          "no cell",
          "a test",
          nullptr,
          create,
          build,
          assign,
          destroy};
}

constexpr clusterbench_method k_methods[] = {
    named("throws"),          named("throws-bytes"),

    named("throws-in-build"), named("writes-struct"), named("leaves-mmx"),  named("cuts-files"),
    named("writes-to-files"), named("sets-variable"), named("masks-files"), named("limits-files"),
    named("blocks-signals"),  named("is-nice")};

}  // namespace

extern "C" CLUSTERBENCH_EXPORT const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host*) {
#ifdef ENTRY_THROWS
  throw std::runtime_error("no licence");
#endif
  constexpr std::size_t k_count = sizeof k_methods / sizeof *k_methods;
  static const clusterbench_method* methods[k_count];
  for (std::size_t i = 0; i < k_count; ++i) methods[i] = &k_methods[i];
  static const clusterbench_plugin plugin = {
      sizeof plugin, CLUSTERBENCH_PLUGIN_MAJOR, CLUSTERBENCH_PLUGIN_MINOR, k_count, "bare", "Bare", "1", methods};
  return &plugin;
}
