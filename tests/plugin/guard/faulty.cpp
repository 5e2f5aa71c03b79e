// A method that breaks down as it is told to, for tests of what a run does then. Without a fault it lists every light
// in every cell.

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "clusterbench_plugin.hpp"

#ifndef FAULT
#define FAULT "none"
#define PLACES \
  { "create", "build", "assign", "destroy", "unload", "rounds" }
#define ID "guard"
#endif

namespace sdk = clusterbench::sdk;

namespace {

std::string g_fault_at_unloading;
bool g_has_forked = false;

[[noreturn]] void hang() {
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

void die_by(int number) {
  std::signal(number, SIG_DFL);  // also where a sanitizer handles it
  std::raise(number);
}

[[noreturn]] void eat() {
  std::vector<std::vector<char>> all;
  for (;;) {
    all.emplace_back(std::size_t{8} << 20, 'x');
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void overflow_stack(volatile char* above) {
  if (above == nullptr) return;
  volatile char more[4096];
  more[0] = above[0];
  overflow_stack(more);
  above[0] = more[1];
}

void commit(const std::string& fault) {
  if (fault == "segv") die_by(SIGSEGV);
  if (fault == "fpe") die_by(SIGFPE);
  if (fault == "ill") die_by(SIGILL);
  if (fault == "abort") std::abort();
  if (fault == "exit") std::exit(0);
  if (fault == "throw") throw std::runtime_error("cannot go on");
  if (fault == "hang") hang();
  if (fault == "eat") eat();
  if (fault == "fork" && !std::exchange(g_has_forked, true)) ::fork();  // once a process: else it is a fork bomb
  if (fault == "close")
    for (int i = 1; i < 64; ++i) ::close(i);
  if (fault == "overflow") {
    volatile char first[1] = {0};
    overflow_stack(first);
  }
}

bool is_beside_another_program() {
  std::ifstream in("/proc/self/cmdline");
  return std::string(std::istreambuf_iterator<char>(in), {}).find("--rounds-server") != std::string::npos;
}

// Breaks down as the process ends.
struct AtUnloading {
  ~AtUnloading() { commit(g_fault_at_unloading); }
} g_at_unloading;

class Faulty : public sdk::Method {
 public:
  static sdk::Description description() {
    sdk::Description out;
    out.name = "faulty";
    out.summary = "all cells, until it breaks down";
    out.source = "a test";
    out.flags = CLUSTERBENCH_CONSERVATIVE | CLUSTERBENCH_ORTHOGRAPHIC | CLUSTERBENCH_BY_NAME;
    out.parameters = {
        sdk::text("fault", FAULT,
                  {"none", "segv", "fpe", "ill", "abort", "exit", "throw", "hang", "eat", "overflow", "twice", "fork",
                   "close"})
            .says("how it breaks down"),
        sdk::text("at", "assign", PLACES).says("in which function; rounds: in assign(), beside another program"),
        sdk::number("call", 1.0, 1.0, 1e9).whole().says("in which of its calls of assign()"),
        sdk::number("nap", 0.0, 0.0, 1000.0).in("ms").says("how long each assign() sleeps")};
    return out;
  }

  explicit Faulty(const sdk::Values& values)
      : fault_(values.text("fault")),
        at_(values.text("at")),
        call_(static_cast<int>(values.number("call"))),
        nap_ms_(values.number("nap")) {
    commit_at("create");
  }
  ~Faulty() override { commit_at("destroy"); }

  void build(const clusterbench_grid& grid, std::uint32_t) override {
    commit_at("build");
    cell_count_ = grid.cell_count;
  }

  void assign(const clusterbench_frame&, const clusterbench_lights& lights, clusterbench_lists& out) override {
    if (nap_ms_ > 0.0) std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(nap_ms_));
    if (at_ == "unload") g_fault_at_unloading = fault_;
    if (++calls_ == call_) commit_at("assign");
    if (at_ == "rounds" && is_beside_another_program()) commit(fault_);
    const std::uint32_t count = sdk::light_count(lights);
    const std::uint64_t all = std::uint64_t{count} * cell_count_;
    if (all > out.capacity) throw sdk::More{all};
    for (std::uint32_t cell = 0; cell < cell_count_; ++cell) {
      out.begin[cell] = cell * count;
      for (std::uint32_t light = 0; light < count; ++light) out.lights[cell * count + light] = light;
    }
    if (fault_ == "twice" && calls_ >= call_ && count > 1) out.lights[1] = out.lights[0];
    out.begin[cell_count_] = static_cast<std::uint32_t>(all);
    out.count = all;
  }

 private:
  void commit_at(const char* place) const {
    if (at_ == place) commit(fault_);
  }

  std::string fault_, at_;
  int call_, calls_ = 0;
  double nap_ms_;
  std::uint32_t cell_count_ = 0;
};

}  // namespace

CLUSTERBENCH_PLUGIN(ID, "A method that breaks down", "1.0", Faulty)
