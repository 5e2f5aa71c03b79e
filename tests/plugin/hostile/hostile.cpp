// Methods that do what none may do, one each, and otherwise nothing. They run only where they are named.

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <vector>

#include "clusterbench_plugin.hpp"

namespace sdk = clusterbench::sdk;

namespace {

// Lists nothing.
class Empty : public sdk::Method {
 public:
  static sdk::Description named(const char* name, const char* summary) {
    sdk::Description out;
    out.name = name;
    out.summary = summary;
    out.source = "a test";
    out.flags = CLUSTERBENCH_BY_NAME;
    return out;
  }
  void build(const clusterbench_grid&, std::uint32_t) override {}
  void assign(const clusterbench_frame& frame, const clusterbench_lights& lights, clusterbench_lists& out) override {
    std::fill_n(out.begin, out.cell_count + std::size_t{1}, 0u);
    out.count = 0;
    misbehave(frame, lights, out);
  }
  virtual void misbehave(const clusterbench_frame&, const clusterbench_lights&, clusterbench_lists&) {}
};

// Lists the first light in the first cell, whether there is one or not.
void list_first(clusterbench_lists& out) {
  if (out.capacity < 1) throw sdk::More{1};
  std::fill_n(out.begin + 1, out.cell_count, 1u);
  out.lights[0] = 0;
  out.count = 1;
}

// CLUSTERBENCH_HOSTILE(Class, name, summary, body): what assign() does beside leaving empty lists.
#define CLUSTERBENCH_HOSTILE(Class, name, summary, ...)                    \
  class Class : public Empty {                                             \
   public:                                                                 \
    explicit Class(const sdk::Values&) {}                                  \
    static sdk::Description description() { return named(name, summary); } \
    void misbehave([[maybe_unused]] const clusterbench_frame& frame,       \
                   [[maybe_unused]] const clusterbench_lights& lights,     \
                   [[maybe_unused]] clusterbench_lists& out) override {    \
      __VA_ARGS__                                                          \
    }                                                                      \
  };

CLUSTERBENCH_HOSTILE(Crashes, "crashes", "reads what is not there", {
  volatile int* const nothing = nullptr;
  *nothing = 1;
})
CLUSTERBENCH_HOSTILE(Aborts, "aborts", "aborts the process", std::abort();)
CLUSTERBENCH_HOSTILE(Exits, "exits", "ends the process as if all were well", std::_Exit(0);)
CLUSTERBENCH_HOSTILE(Hangs, "hangs", "never returns", for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));)
CLUSTERBENCH_HOSTILE(Throws, "throws", "throws a std::exception", throw std::runtime_error("no such tile");)
CLUSTERBENCH_HOSTILE(ThrowsOther, "throws-other", "throws what is no std::exception", throw 7;)
CLUSTERBENCH_HOSTILE(Prints, "prints", "prints lines",
                     std::puts("clusterbench plugin check: {}\n{\"verdict\": \"passed\"}");)
// Once a process: else it is a fork bomb.
CLUSTERBENCH_HOSTILE(Forks, "forks", "comes back twice", {
  static std::atomic<bool> has_forked{false};
  if (!has_forked.exchange(true)) ::fork();
})
CLUSTERBENCH_HOSTILE(LeavesChild, "leaves-child", "leaves a process running", {
  static std::atomic<bool> has_forked{false};
  if (!has_forked.exchange(true) && ::fork() == 0) {
    ::sleep(60);
    ::_exit(0);
  }
})
CLUSTERBENCH_HOSTILE(LeavesThread, "leaves-thread", "leaves threads running", {
  static std::atomic<int> started{0};
  if (started++ < 100)
    std::thread([] {
      for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    }).detach();
})
CLUSTERBENCH_HOSTILE(Spins, "spins", "leaves a thread that never rests", {
  static std::atomic<bool> has_started{false};
  if (!has_started.exchange(true))
    std::thread([] {
      for (volatile unsigned i = 0;;) i = i + 1;
    }).detach();
})
CLUSTERBENCH_HOSTILE(HangsWithChild, "hangs-with-child", "never returns, and neither does its child", {
  static std::atomic<bool> has_forked{false};
  if (!has_forked.exchange(true)) ::fork();
  for (;;) ::sleep(1);
})
CLUSTERBENCH_HOSTILE(Closes, "closes", "closes files of others", for (int i = 1; i < 64; ++i)::close(i);)
CLUSTERBENCH_HOSTILE(Handles, "handles", "handles signals", std::signal(SIGALRM, [](int) {});)
CLUSTERBENCH_HOSTILE(Moves, "moves", "changes the working directory", if (::chdir("/") != 0) std::abort();)
CLUSTERBENCH_HOSTILE(Translates, "translates", "changes the locale", std::setlocale(LC_ALL, "C.UTF-8");)
CLUSTERBENCH_HOSTILE(WritesBehind, "writes-behind", "writes behind its lists", out.begin[out.cell_count + 1] = 7;)
CLUSTERBENCH_HOSTILE(WritesInput, "writes-input", "writes to its lights", const_cast<float*>(lights.x)[0] = 0.0f;)
CLUSTERBENCH_HOSTILE(ReadsBehind, "reads-behind", "reads behind its lights",
                     out.tests_done = lights.radius[sdk::light_count(lights)] > 0.0f ? 1 : 0;)
CLUSTERBENCH_HOSTILE(ReadsBefore, "reads-before", "reads before its lights",
                     out.tests_done = lights.radius[-1] > 0.0f ? 1 : 0;)
CLUSTERBENCH_HOSTILE(NoIndex, "no-index", "lists a light that does not exist", {
  if (out.capacity < 1) throw sdk::More{1};
  std::fill_n(out.begin + 1, out.cell_count, 1u);
  out.lights[0] = sdk::light_count(lights);
  out.count = 1;
})
CLUSTERBENCH_HOSTILE(Ghost, "ghost", "always lists the first light", list_first(out);)
CLUSTERBENCH_HOSTILE(Greedy, "greedy", "always asks for more room", throw sdk::More{out.capacity + 1};)
CLUSTERBENCH_HOSTILE(Late, "late", "wants more room than it needs, and writes without", {
  if (out.capacity == 0 && sdk::light_count(lights) > 0) out.lights[0] = 0;
})

// Lists the first light in a cell that changes from call to call.
class Remembers : public Empty {
 public:
  explicit Remembers(const sdk::Values&) {}
  static sdk::Description description() { return named("remembers", "lists depend on how often it was called"); }
  void misbehave(const clusterbench_frame&, const clusterbench_lights& lights, clusterbench_lists& out) override {
    if (sdk::light_count(lights) == 0) return;
    if (out.capacity < 1) throw sdk::More{1};
    const std::uint32_t cell = calls_++ % out.cell_count;
    std::fill(out.begin + cell + 1, out.begin + out.cell_count + 1, 1u);
    out.lights[0] = 0;
    out.count = 1;
  }

 private:
  std::uint32_t calls_ = 0;
};

// The same, for all instances together.
class Shares : public Empty {
 public:
  explicit Shares(const sdk::Values&) { ++instances; }
  ~Shares() override { --instances; }
  static sdk::Description description() { return named("shares", "lists depend on other instances"); }
  void misbehave(const clusterbench_frame&, const clusterbench_lights& lights, clusterbench_lists& out) override {
    if (sdk::light_count(lights) > 0 && instances > 1) list_first(out);
  }

 private:
  static int instances;
};
int Shares::instances = 0;

// The same, for calls at the same time.
class Races : public Empty {
 public:
  explicit Races(const sdk::Values&) {}
  static sdk::Description description() { return named("races", "lists depend on other threads"); }
  void misbehave(const clusterbench_frame&, const clusterbench_lights& lights, clusterbench_lists& out) override {
    const int others = inside++;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    --inside;
    if (sdk::light_count(lights) > 0 && others > 0) list_first(out);
  }

 private:
  static std::atomic<int> inside;
};
std::atomic<int> Races::inside = 0;

class CountsBuilds : public Empty {
 public:
  explicit CountsBuilds(const sdk::Values&) {}
  static sdk::Description description() { return named("counts-builds", "lists depend on how often it was built"); }
  void build(const clusterbench_grid&, std::uint32_t) override { ++builds_; }
  void misbehave(const clusterbench_frame&, const clusterbench_lights& lights, clusterbench_lists& out) override {
    if (sdk::light_count(lights) > 0 && builds_ > 1) list_first(out);
  }

 private:
  int builds_ = 0;
};

class Leaks : public Empty {
 public:
  explicit Leaks(const sdk::Values&) { lost = new char[4096]; }
  static sdk::Description description() { return named("leaks", "frees nothing"); }

 private:
  static char* volatile lost;
};
char* volatile Leaks::lost = nullptr;

// Says that it loses nothing.
class Loses : public Empty {
 public:
  explicit Loses(const sdk::Values&) {}
  static sdk::Description description() {
    sdk::Description out = named("loses", "no cell, and says that these are all");
    out.flags |= CLUSTERBENCH_CONSERVATIVE;
    return out;
  }
};

// Fails for one value of its parameter.
class Picky : public Empty {
 public:
  explicit Picky(const sdk::Values& values) {
    if (values.number("size") == 8.0) throw std::runtime_error("8 is too large");
  }
  static sdk::Description description() {
    sdk::Description out = named("picky", "takes not all that it says");
    out.parameters = {sdk::number("size", 2.0, 1.0, 8.0).says("a size")};
    return out;
  }
};

// No more than two gigabytes: nobody may end it.
class Eats : public Empty {
 public:
  explicit Eats(const sdk::Values&) {}
  static sdk::Description description() { return named("eats", "takes more memory all the time"); }
  void misbehave(const clusterbench_frame&, const clusterbench_lights&, clusterbench_lists&) override {
    std::vector<std::vector<char>> all;
    while (all.size() < 256) {
      all.emplace_back(std::size_t{8} << 20, 'x');
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
};

class Slow : public Empty {
 public:
  explicit Slow(const sdk::Values&) { std::this_thread::sleep_for(std::chrono::milliseconds(100)); }
  static sdk::Description description() { return named("slow", "takes its time to be made"); }
};

class Good : public Empty {
 public:
  explicit Good(const sdk::Values&) {}
  static sdk::Description description() { return named("good", "no cell, and promises nothing"); }
};

}  // namespace

CLUSTERBENCH_PLUGIN("hostile", "What no plug-in may do", "1.0", Good, Crashes, Aborts, Exits, Hangs, Throws,
                    ThrowsOther, Prints, WritesBehind, WritesInput, ReadsBehind, ReadsBefore, NoIndex, Greedy, Late,
                    Remembers, Shares, Leaks, Loses, Picky, Ghost, Races, CountsBuilds, Forks, LeavesChild,
                    LeavesThread, Closes, Handles, Moves, Translates, Spins, Slow, HangsWithChild, Eats)
