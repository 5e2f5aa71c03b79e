// A method of a plug-in as an assigner: what it writes is checked, and its lists are those of the program's own method.

#include "plugin/plugin_method.h"

#include <gtest/gtest.h>

#include <pthread.h>

#include <cfenv>
#include <functional>
#include <stdexcept>

#include "assign/contract.h"
#include "assign/contract/assigner_run.h"
#include "assign/contract/method_error.h"
#include "core/memory.h"
#include "core/text.h"
#include "effort.h"
#include "os/call_notes.h"
#include "os/kept_files.h"
#include "plugin/exported_method.h"
#include "plugin/plugin_by_hand.h"

namespace clusterbench::assign {
extern const AssignerDescriptor cell_spheres_descriptor;  // of CONTRIBUTING.md
}  // namespace clusterbench::assign

namespace clusterbench::plugin::testing {
namespace {

using assign::testing::Setting;
using assign::testing::settings_for;

// A plug-in of one method.
struct OneMethod {
  explicit OneMethod(const clusterbench_method* method) : methods{method} {
    plugin = {sizeof plugin, CLUSTERBENCH_PLUGIN_MAJOR, 0, 1, "one", "One method", "1", methods};
  }
  const clusterbench_method* methods[1];
  clusterbench_plugin plugin{};
};

assign::AssignerDescriptor runnable(const MethodFacts& facts) {
  assign::AssignerDescriptor descriptor = facts.descriptor;
  descriptor.make = [&facts](const assign::Params& params) -> std::unique_ptr<assign::ListAssigner> {
    return std::make_unique<PluginMethod>(facts, "one.so", params);
  };
  return descriptor;
}

// --- All of the program's own methods, through the interface and back ---

TEST(EveryMethodThroughTheInterface, gives_the_same_lists) {
  std::size_t compared = 0;
  for (const assign::AssignerDescriptor* own : assign::assigner_descriptors()) {
    if (!own->answers(assign::Answer::lists)) continue;
    const ExportedMethod exported(*own);
    const OneMethod one(exported.table());
    const PluginFacts facts = read_plugin("one.so", &one.plugin);
    const assign::AssignerDescriptor foreign = runnable(facts.methods[0]);
    EXPECT_EQ(foreign.conservative, own->conservative) << own->name;
    EXPECT_EQ(foreign.kinds, own->kinds) << own->name;
    ASSERT_EQ(foreign.params.size(), own->params.size()) << own->name;
    for (const Setting& setting : settings_for(*own, 11))
      for (const assign::Params& params : assign::testing::params_of(*own)) {
        const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
        assign::AssignerRun here(*own, params, assign::Answer::lists), there(foreign, params, assign::Answer::lists);
        for (assign::AssignerRun* run : {&here, &there}) {
          run->build(setting.grid);
          run->assign(setting.input(lights));
        }
        EXPECT_EQ(*here.filled_lists(), *there.filled_lists()) << own->name << " on " << setting.name;
        EXPECT_EQ(here.tests_done(), there.tests_done()) << own->name << " on " << setting.name;
        EXPECT_EQ(here.fallbacks(), there.fallbacks()) << own->name << " on " << setting.name;
        ++compared;
      }
  }
  EXPECT_GT(compared, 100u);
}

// The same file as one of the program's own methods, and as a method of a plug-in.
TEST(ExampleOfContributing, is_a_method_and_a_plugin) {
  const assign::AssignerDescriptor& own = assign::cell_spheres_descriptor;
  const assign::AssignerRegistration registered(own);
  const ExportedMethod exported(own);
  const OneMethod one(exported.table());
  const PluginFacts facts = read_plugin("one.so", &one.plugin);
  const assign::AssignerDescriptor foreign = runnable(facts.methods[0]);
  for (const Setting& setting : settings_for(own, 21)) {
    const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
    assign::AssignerRun here(registered.descriptor(), assign::Params(own.params), assign::Answer::lists),
        there(foreign, assign::Params(foreign.params), assign::Answer::lists);
    for (assign::AssignerRun* run : {&here, &there}) {
      run->build(setting.grid);
      run->assign(setting.input(lights));
    }
    EXPECT_GT(here.filled_lists()->pair_count(), 0u) << setting.name;
    EXPECT_EQ(*here.filled_lists(), *there.filled_lists()) << setting.name;
    const std::vector<std::string> faults =
        assign::testing::contract_faults(foreign, assign::Params(foreign.params), setting);
    EXPECT_TRUE(faults.empty()) << setting.name << ": " << joined(faults, "; ");
  }
}

TEST(EveryMethodThroughTheInterface, keeps_the_contract_of_methods) {
  for (const char* name : {"aabb", "exact-fast", "cascades", "world-grid", "distance", "light-boxes"}) {
    const assign::AssignerDescriptor& own = *assign::find_assigner(name);
    const ExportedMethod exported(own);
    const OneMethod one(exported.table());
    const PluginFacts facts = read_plugin("one.so", &one.plugin);
    const assign::AssignerDescriptor foreign = runnable(facts.methods[0]);
    for (const Setting& setting : settings_for(foreign, 5)) {
      const std::vector<std::string> faults =
          assign::testing::contract_faults(foreign, assign::Params(foreign.params), setting);
      EXPECT_TRUE(faults.empty()) << name << " on " << setting.name << ": " << joined(faults, "; ");
    }
  }
}

// --- Methods that break the interface ---

// What assign() of the method does, while a test runs.
std::function<clusterbench_status(const clusterbench_lights&, clusterbench_lists&, clusterbench_error&)> assigns;

std::string fault_of(decltype(assigns) work) {
  assigns = std::move(work);
  PluginByHand hand;
  hand.method.assign = [](void*, const clusterbench_frame*, const clusterbench_lights* lights, clusterbench_lists* out,
                          clusterbench_error* error) -> clusterbench_status {
    for (std::uint32_t cell = 0; cell <= out->cell_count; ++cell) out->begin[cell] = 0;
    return assigns(*lights, *out, *error);
  };
  hand.method.light_types = CLUSTERBENCH_POINTS | CLUSTERBENCH_SPOTS;
  hand.method.grid_kinds = CLUSTERBENCH_FRUSTUM;
  const PluginFacts facts = read_plugin("hand.so", &hand.plugin);
  const assign::AssignerDescriptor descriptor = runnable(facts.methods[0]);
  const std::vector<Setting> settings = settings_for(descriptor, 3);
  const Setting& setting = settings.front();
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  try {
    assign::AssignerRun run(descriptor, assign::Params(descriptor.params), assign::Answer::lists);
    run.build(setting.grid);
    run.assign(setting.input(lights));
    return "";
  } catch (const assign::MethodError& error) {
    EXPECT_EQ(error.method(), "hand.cells");
    return error.what();
  }
}

// Lists these lights in the first cell.
clusterbench_status list_in_first(const std::vector<std::uint32_t>& lights, clusterbench_lists& out) {
  std::copy(lights.begin(), lights.end(), out.lights);
  for (std::uint32_t cell = 1; cell <= out.cell_count; ++cell)
    out.begin[cell] = static_cast<std::uint32_t>(lights.size());
  out.count = lights.size();
  return CLUSTERBENCH_OK;
}

struct Broken {
  std::string says;
  decltype(assigns) work;
};

const Broken k_broken[] = {
    {"a light that does not exist (cell 0)",
     [](const auto& lights, auto& out, auto&) { return list_in_first({lights.point_count + lights.spot_count}, out); }},
    {"a light that does not exist (cell 0)", [](const auto&, auto& out, auto&) { return list_in_first({~0u}, out); }},
    {"lights not each once (cell 0)",
     [](const auto&, auto& out, auto&) {
       return list_in_first({3, 4, 3}, out);
     }},
    {"a point light behind spots (cell 0)",
     [](const auto& lights, auto& out, auto&) {
       return list_in_first({lights.point_count, 0}, out);
     }},
    {"a list of negative length (cell 1)",
     [](const auto&, auto& out, auto&) -> clusterbench_status {
       list_in_first({0, 1}, out);
       out.begin[2] = 1;
       return CLUSTERBENCH_OK;
     }},
    {"a list that ends behind the indices (cell 0)",
     [](const auto&, auto& out, auto&) -> clusterbench_status {
       list_in_first({0, 1}, out);
       out.begin[1] = 1u << 30;
       return CLUSTERBENCH_OK;
     }},
    {"its lists begin at 1 and end at 2",
     [](const auto&, auto& out, auto&) -> clusterbench_status {
       list_in_first({0, 1}, out);
       out.begin[0] = 1;
       return CLUSTERBENCH_OK;
     }},
    {"says that it wrote 1 pairs, but its lists begin at 0 and end at 2",
     [](const auto&, auto& out, auto&) -> clusterbench_status {
       list_in_first({0, 1}, out);
       out.count = 1;
       return CLUSTERBENCH_OK;
     }},
    {"says that it wrote 18446744073709551615 pairs where there is room for",
     [](const auto&, auto& out, auto&) -> clusterbench_status {
       out.count = ~std::uint64_t{0};
       return CLUSTERBENCH_OK;
     }},
    {"asks for room for 0 pairs where it has room for 65536",
     [](const auto&, auto&, auto&) { return CLUSTERBENCH_MORE; }},
    {"asks for room for 18446744073709551615 pairs where it has room for",
     [](const auto&, auto& out, auto&) -> clusterbench_status {
       out.count = ~std::uint64_t{0};
       return CLUSTERBENCH_MORE;
     }},
    {"asks for room for",  // for ever
     [](const auto&, auto& out, auto&) -> clusterbench_status {
       out.count = out.capacity + 1;
       return CLUSTERBENCH_MORE;
     }},
    {"assign() failed: no table",
     [](const auto&, auto&, auto& error) -> clusterbench_status {
       std::snprintf(error.text, error.capacity, "no table");
       return CLUSTERBENCH_FAILED;
     }},
    {"assign() failed: a?b",
     [](const auto&, auto&, auto& error) -> clusterbench_status {
       std::snprintf(error.text, error.capacity, "a\nb");
       return CLUSTERBENCH_FAILED;
     }},
    {"assign() had too little memory", [](const auto&, auto&, auto&) { return CLUSTERBENCH_OUT_OF_MEMORY; }},
    {"assign() returned the unknown status 77", [](const auto&, auto&, auto&) { return 77; }},
};

TEST(PluginMethod, what_breaks_the_interface_is_its_fault_and_says_so) {
  for (const Broken& broken : k_broken) {
    const std::string fault = fault_of(broken.work);
    EXPECT_NE(fault.find(broken.says), std::string::npos) << broken.says << "\n" << fault;
    EXPECT_TRUE(fault.starts_with("one.so: hand.cells: ")) << fault;
  }
}

TEST(PluginMethod, refuses_numbers_that_no_frame_can_have) {
  const std::pair<const char*, std::uint64_t clusterbench_lists::*> k_numbers[] = {
      {"tests_done", &clusterbench_lists::tests_done},
      {"fallbacks", &clusterbench_lists::fallbacks},
      {"scratch_bytes", &clusterbench_lists::scratch_bytes}};
  for (const auto& [name, member] : k_numbers)
    for (const std::uint64_t number : {~std::uint64_t{0}, std::uint64_t{1} << 62}) {
      const std::string fault = fault_of([member = member, number](const auto&, auto& out, auto&) {
        out.*member = number;
        return CLUSTERBENCH_OK;
      });
      EXPECT_NE(fault.find(std::string(name) + " is " + std::to_string(number) + ", allowed: at most 2^48"),
                std::string::npos)
          << fault;
    }
}

TEST(PluginMethod, that_changes_the_rounding_mode_fails_and_the_mode_is_set_back) {
  const std::string fault = fault_of([](const auto&, auto&, auto&) {
    std::fesetround(FE_UPWARD);
    return CLUSTERBENCH_OK;
  });
  const int mode = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(mode, FE_TONEAREST);
  EXPECT_NE(fault.find("assign() left another rounding mode"), std::string::npos) << fault;
}

// An exception is of the call that it left, and of nothing else.
TEST(PluginMethod, that_an_exception_leaves_fails_with_its_words) {
  using Work = decltype(assigns);
  const std::pair<Work, std::string> k_thrown[] = {
      {[](const auto&, auto&, auto&) -> clusterbench_status { throw std::out_of_range("range check"); }, "range check"},
      {[](const auto&, auto&, auto&) -> clusterbench_status { throw std::runtime_error(""); },
       "of the type std::runtime_error"},
      {[](const auto&, auto&, auto&) -> clusterbench_status { throw 42; }, "of the type int"},
      {[](const auto&, auto&, auto&) -> clusterbench_status { throw std::runtime_error("a\xff\nb"); },
       printable("a\xff\nb")},
      {[](const auto&, auto&, auto&) -> clusterbench_status { throw Error("f", "w", "m"); }, "f: w: m"}};
  for (const auto& [work, words] : k_thrown)
    EXPECT_EQ(fault_of(work), "one.so: hand.cells: an exception left assign(): " + words);
}

TEST(PluginMethod, that_an_exception_leaves_has_its_mode_and_inputs_set_back) {
  const std::string fault = fault_of([](const clusterbench_lights& lights, auto&, auto&) -> clusterbench_status {
    const_cast<float*>(lights.x)[0] += 1.0f;
    std::fesetround(FE_UPWARD);
    throw 42;
  });
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_NE(fault.find("an exception left assign()"), std::string::npos) << fault;
}

TEST(PluginMethod, that_an_exception_leaves_in_create_and_build_fails) {
  PluginByHand hand;
  hand.method.grid_kinds = CLUSTERBENCH_FRUSTUM;
  hand.method.build = [](void*, const clusterbench_grid*, std::uint32_t, clusterbench_error*) -> clusterbench_status {
    throw std::runtime_error("no table");
  };
  const PluginFacts facts = read_plugin("hand.so", &hand.plugin);
  const assign::AssignerDescriptor descriptor = runnable(facts.methods[0]);
  const std::vector<Setting> settings = settings_for(descriptor, 3);
  const auto fault = [&] {
    try {
      assign::AssignerRun run(descriptor, assign::Params(descriptor.params), assign::Answer::lists);
      run.build(settings.front().grid);
      return std::string();
    } catch (const assign::MethodError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(fault(), "one.so: hand.cells: an exception left build(): no table");
  hand.method.create = [](const clusterbench_method*, const clusterbench_value*, std::uint32_t, void**,
                          clusterbench_error*) -> clusterbench_status { throw std::runtime_error("no licence"); };
  hand.method.destroy = [](void*) { ADD_FAILURE() << "destroys what it did not create"; };
  const PluginFacts changed = read_plugin("hand.so", &hand.plugin);
  const assign::AssignerDescriptor other = runnable(changed.methods[0]);
  EXPECT_THROW(assign::AssignerRun(other, assign::Params(other.params), assign::Answer::lists), assign::MethodError);
}

TEST(PluginMethod, that_an_exception_leaves_in_destroy_aborts_with_its_words) {
  const auto in_a_copy_on_purpose = [] {
    os::note_own_process();
    os::keep_standard_files();  // the test reads standard error
    PluginByHand hand;
    hand.method.destroy = [](void*) { throw std::runtime_error("no end"); };
    const PluginFacts facts = read_plugin("hand.so", &hand.plugin);
    PluginMethod(facts.methods[0], "hand.so", assign::Params(facts.methods[0].descriptor.params));
  };
  EXPECT_DEATH(in_a_copy_on_purpose(), "an exception left destroy\\(\\): no end");
}

#if defined(__x86_64__)
// Sums in the 80 bits of the x87 are NaN while its registers are in use.
long double sum_of_x87(long double a, long double b) {
  const volatile long double x = a, y = b;
  return x + y;
}

TEST(PluginMethod, that_leaves_the_x87_in_use_fails_and_the_registers_are_emptied) {
  const std::pair<const char*, void (*)()> k_ways[] = {
      {"MMX without emms", [] { asm volatile("pxor %mm0, %mm0"); }},
      {"a full stack", [] { asm volatile("fld1\n\tfld1\n\tfld1\n\tfld1\n\tfld1\n\tfld1\n\tfld1\n\tfld1"); }},
      {"one number", [] { asm volatile("fldz"); }}};
  for (const auto& [name, leave] : k_ways) {
    const std::string fault = fault_of([leave = leave](const auto&, auto&, auto&) -> clusterbench_status {
      leave();
      return CLUSTERBENCH_OK;
    });
    EXPECT_EQ(sum_of_x87(1.0L, 2.0L), 3.0L) << name;
    EXPECT_NE(fault.find("assign() left the x87 registers in use (MMX code without emms)"), std::string::npos)
        << name << ": " << fault;
  }
}

TEST(PluginMethod, that_uses_mmx_and_empties_it_is_right) {
  EXPECT_EQ(fault_of([](const auto&, auto&, auto&) -> clusterbench_status {
              asm volatile("pxor %mm0, %mm0\n\temms");
              return CLUSTERBENCH_OK;
            }),
            "");
}
#endif

TEST(PluginMethod, that_writes_to_a_struct_fails) {
  const std::string fault = fault_of([](const clusterbench_lights& lights, auto&, auto&) {
    const_cast<clusterbench_lights&>(lights).point_count = 0;
    return CLUSTERBENCH_OK;
  });
  EXPECT_NE(fault.find("assign() wrote to the lights' struct, which is to be read only"), std::string::npos) << fault;
}

TEST(PluginMethod, that_writes_to_its_grid_changes_no_other_number) {
  PluginByHand hand;
  hand.method.grid_kinds = CLUSTERBENCH_FRUSTUM;
  hand.method.build = [](void*, const clusterbench_grid* grid, std::uint32_t,
                         clusterbench_error*) -> clusterbench_status {
    const_cast<clusterbench_grid*>(grid)->cell_count = 1;
    return CLUSTERBENCH_OK;
  };
  const PluginFacts facts = read_plugin("hand.so", &hand.plugin);
  const assign::AssignerDescriptor descriptor = runnable(facts.methods[0]);
  const std::vector<Setting> settings = settings_for(descriptor, 3);
  assign::AssignerRun run(descriptor, assign::Params(descriptor.params), assign::Answer::lists);
  try {
    run.build(settings.front().grid);
    ADD_FAILURE() << "takes it";
  } catch (const assign::MethodError& error) {
    EXPECT_STREQ(error.what(), "one.so: hand.cells: build() wrote to the grid's struct, which is to be read only");
  }
}

TEST(PluginMethod, that_writes_to_its_lights_fails) {
  const std::string fault = fault_of([](const clusterbench_lights& lights, auto&, auto&) {
    const_cast<float*>(lights.x)[0] += 1.0f;
    const_cast<float*>(lights.reach)[1] += 1.0f;
    return CLUSTERBENCH_OK;
  });
  EXPECT_NE(fault.find("assign() wrote to lights.x, lights.reach, which is to be read only"), std::string::npos)
      << fault;
}

TEST(KeptInputs, puts_back_what_was_written) {
  std::vector<float> x{1.0f, 2.0f}, y{3.0f};
  KeptInputs kept;
  kept.keep("x", x.data(), x.size());
  kept.keep("y", y.data(), y.size());
  EXPECT_EQ(kept.put_back(), "");
  x[1] = 7.0f;
  EXPECT_EQ(kept.put_back(), "x");
  EXPECT_EQ(x, (std::vector<float>{1.0f, 2.0f}));
}

TEST(PluginMethod, that_ends_its_thread_ends_the_process_with_a_sentence_and_no_success) {
#if defined(__GLIBC__) && defined(_LIBCPP_VERSION)
  GTEST_SKIP() << "skipped: with libc++ no exception tells that a thread ends";
#endif
  const auto in_a_copy_on_purpose = [] {
    os::note_own_process();
    os::keep_standard_files();  // the test reads standard error
    fault_of([](const auto&, auto&, auto&) -> clusterbench_status { pthread_exit(nullptr); });
  };
  EXPECT_EXIT(in_a_copy_on_purpose(), ::testing::ExitedWithCode(static_cast<int>(ExitCode::internal)),
              "a plug-in ended the thread");
}

TEST(PluginMethod, takes_lists_that_are_right) {
  EXPECT_EQ(fault_of([](const auto&, auto& out, auto&) { return list_in_first({4, 2, 3}, out); }), "");
  EXPECT_EQ(fault_of([](const auto&, auto&, auto&) { return CLUSTERBENCH_OK; }), "");
}

TEST(PluginMethod, gets_the_room_that_it_asks_for) {
  int calls = 0;
  const std::string fault = fault_of([&](const clusterbench_lights& lights, clusterbench_lists& out, auto&) {
    ++calls;
    const std::uint32_t all = lights.point_count + lights.spot_count;
    out.count = std::uint64_t{all} * out.cell_count;
    if (out.count > out.capacity) return static_cast<clusterbench_status>(CLUSTERBENCH_MORE);
    for (std::uint32_t cell = 0; cell < out.cell_count; ++cell) {
      out.begin[cell + 1] = (cell + 1) * all;
      for (std::uint32_t light = 0; light < all; ++light) out.lights[cell * all + light] = light;
    }
    return static_cast<clusterbench_status>(CLUSTERBENCH_OK);
  });
  EXPECT_EQ(fault, "");
  EXPECT_EQ(calls, 2);
}

TEST(PluginMethod, asks_for_no_more_than_the_memory_limit) {
  const MemoryLimitScope limit(1 << 20);
  EXPECT_THROW(fault_of([&](const clusterbench_lights& lights, clusterbench_lists& out, auto&) -> clusterbench_status {
                 out.count = std::uint64_t{lights.point_count} * out.cell_count;
                 return CLUSTERBENCH_MORE;
               }),
               Error);
}

TEST(PluginMethod, a_refusal_to_create_is_its_fault) {
  PluginByHand hand;
  hand.method.create = [](const clusterbench_method*, const clusterbench_value*, std::uint32_t, void**,
                          clusterbench_error* error) -> clusterbench_status {
    std::snprintf(error->text, error->capacity, "no licence");
    return CLUSTERBENCH_INVALID;
  };
  hand.method.destroy = [](void*) { ADD_FAILURE() << "destroys what it did not create"; };
  const PluginFacts facts = read_plugin("hand.so", &hand.plugin);
  try {
    PluginMethod(facts.methods[0], "hand.so", assign::Params(facts.methods[0].descriptor.params));
    ADD_FAILURE();
  } catch (const assign::MethodError& error) {
    EXPECT_STREQ(error.what(), "hand.so: hand.cells: create() found its parameters invalid: no licence");
  }
}

TEST(PluginMethod, create_gets_the_values_in_the_order_of_the_parameters) {
  static std::string seen;
  seen.clear();
  PluginByHand hand;
  hand.method.create = [](const clusterbench_method* method, const clusterbench_value* values, std::uint32_t count,
                          void**, clusterbench_error* error) -> clusterbench_status {
    for (std::uint32_t i = 0; i < count; ++i)
      seen += std::string(values[i].name) + "=" + (values[i].text ? values[i].text : std::to_string(values[i].number)) +
              " ";
    return clusterbench_check_values(method, values, count, error);
  };
  const PluginFacts facts = read_plugin("hand.so", &hand.plugin);
  const std::vector<assign::ParamSpec>& specs = facts.methods[0].descriptor.params;
  PluginMethod(facts.methods[0], "hand.so", assign::Params(specs, {{"way", std::string("slow")}, {"on", false}}));
  EXPECT_EQ(seen, "on=0.000000 size=2.000000 way=slow ");
}

}  // namespace
}  // namespace clusterbench::plugin::testing
