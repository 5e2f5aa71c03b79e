// What a plug-in says of itself: all that can be wrong has a sentence with its place.

#include "plugin/read_plugin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "core/error.h"
#include "plugin/interface_in_c.h"
#include "plugin/plugin_by_hand.h"

namespace clusterbench::plugin::testing {
namespace {

TEST(Interface, c_and_cpp_agree_on_the_sizes_of_all_structs) {
  const std::size_t expected[] = {
      sizeof(clusterbench_error), sizeof(clusterbench_parameter), sizeof(clusterbench_value),
      sizeof(clusterbench_grid),  sizeof(clusterbench_frame),     sizeof(clusterbench_lights),
      sizeof(clusterbench_lists), sizeof(clusterbench_method),    sizeof(clusterbench_host),
      sizeof(clusterbench_log),   sizeof(clusterbench_plugin)};
  std::size_t found[16] = {};
  ASSERT_EQ(sizes_in_c(found, 16), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) EXPECT_EQ(found[i], expected[i]) << i;
}

// Plug-ins that were built with version 1.0 have these numbers in them.
TEST(Interface, version_1_0_stays_as_it_is) {
  EXPECT_EQ(sizeof(clusterbench_error), 16u);
  EXPECT_EQ(sizeof(clusterbench_parameter), 88u);
  EXPECT_EQ(sizeof(clusterbench_value), 24u);
  EXPECT_EQ(sizeof(clusterbench_grid), 136u);
  EXPECT_EQ(sizeof(clusterbench_frame), 368u);
  EXPECT_EQ(sizeof(clusterbench_lights), 248u);
  EXPECT_EQ(sizeof(clusterbench_lists), 64u);
  EXPECT_EQ(sizeof(clusterbench_method), 88u);
  EXPECT_EQ(sizeof(clusterbench_host), 40u);
  EXPECT_EQ(sizeof(clusterbench_plugin), 48u);
  EXPECT_EQ(offsetof(clusterbench_plugin, struct_size), 0u);
  EXPECT_EQ(offsetof(clusterbench_plugin, major), 4u);
  EXPECT_EQ(offsetof(clusterbench_plugin, minor), 8u);
}

// A member that is added in a later version would else lie where version 1.0 has nothing, and seem to be there.
TEST(Interface, no_struct_ends_with_a_gap) {
  EXPECT_EQ(sizeof(clusterbench_error), offsetof(clusterbench_error, text) + sizeof(char*));
  EXPECT_EQ(sizeof(clusterbench_parameter), offsetof(clusterbench_parameter, choices) + sizeof(char*));
  EXPECT_EQ(sizeof(clusterbench_grid), offsetof(clusterbench_grid, origin) + 3 * sizeof(double));
  EXPECT_EQ(sizeof(clusterbench_frame), offsetof(clusterbench_frame, depth) + sizeof(float*));
  EXPECT_EQ(sizeof(clusterbench_lights), offsetof(clusterbench_lights, space_rotation) + 9 * sizeof(double));
  EXPECT_EQ(sizeof(clusterbench_lists), offsetof(clusterbench_lists, scratch_bytes) + sizeof(std::uint64_t));
  EXPECT_EQ(sizeof(clusterbench_method), offsetof(clusterbench_method, destroy) + sizeof(void (*)()));
  EXPECT_EQ(sizeof(clusterbench_host), offsetof(clusterbench_host, extension) + sizeof(void (*)()));
  EXPECT_EQ(sizeof(clusterbench_log), offsetof(clusterbench_log, write) + sizeof(void (*)()));
  EXPECT_EQ(sizeof(clusterbench_plugin), offsetof(clusterbench_plugin, methods) + sizeof(void*));
}

TEST(Interface, members_beyond_the_others_size_are_not_there) {
  clusterbench_lights lights{};
  lights.struct_size = offsetof(clusterbench_lights, radius);
  EXPECT_TRUE(CLUSTERBENCH_HAS(clusterbench_lights, &lights, z));
  EXPECT_FALSE(CLUSTERBENCH_HAS(clusterbench_lights, &lights, radius));
}

TEST(Interface, values_are_checked_by_name_and_place) {
  char text[64];
  const auto check = [&](std::vector<const char*> names, unsigned capacity = sizeof text) {
    std::memset(text, 'x', sizeof text);
    names.push_back(nullptr);
    return check_in_c(names.data(), text, capacity);
  };
  EXPECT_EQ(check({"a", "b"}), CLUSTERBENCH_OK);
  EXPECT_EQ(check({"a"}), CLUSTERBENCH_INVALID);
  EXPECT_EQ(check({}), CLUSTERBENCH_INVALID);
  EXPECT_EQ(check({"a", "b", "c"}), CLUSTERBENCH_INVALID);
  EXPECT_EQ(check({"b", "a"}), CLUSTERBENCH_INVALID);
  EXPECT_STREQ(text, "no parameter of this method, or not in its place: b");
  EXPECT_EQ(check({"a", "bb"}), CLUSTERBENCH_INVALID);
  EXPECT_EQ(check({"a", "bb"}, 8), CLUSTERBENCH_INVALID);
  EXPECT_EQ(std::string(text, 9), std::string("no para\0x", 9));  // and nothing behind its room
}

TEST(ReadPlugin, has_all_that_a_plugin_says) {
  const PluginByHand hand;
  const PluginFacts facts = read_plugin("hand.so", &hand.plugin);
  EXPECT_EQ(facts.id + "|" + facts.name + "|" + facts.version, "hand|By hand|1.5");
  ASSERT_EQ(facts.methods.size(), 1u);
  const assign::AssignerDescriptor& method = facts.methods[0].descriptor;
  EXPECT_EQ(method.name, "hand.cells");
  EXPECT_EQ(method.plugin, "hand");
  EXPECT_EQ(method.kinds, (std::vector{grid::Kind::frustum, grid::Kind::world}));
  EXPECT_TRUE(method.points && !method.spots && method.boxes);
  EXPECT_TRUE(method.orthographic && !method.conservative && !method.exact && !method.by_name && !method.needs.depth);
  ASSERT_EQ(method.params.size(), 3u);
  EXPECT_EQ(method.params[0].default_value, assign::ParamValue(true));
  EXPECT_EQ(method.params[1].default_value, assign::ParamValue(2.0));
  EXPECT_EQ(method.params[1].min, 0.5);
  EXPECT_EQ(method.params[1].max, 8.0);
  EXPECT_EQ(method.params[1].unit, "m");
  EXPECT_EQ(method.params[1].conservative_from, 1.0);
  EXPECT_EQ(method.params[2].default_value, assign::ParamValue(std::string("fast")));
  EXPECT_EQ(method.params[2].choices, (std::vector<std::string>{"fast", "slow"}));
  EXPECT_EQ(read_plugin("hand.so", &hand.plugin, "other").methods[0].descriptor.name, "other.cells");
}

// As a plug-in of version 1.7 has it: larger structs, members and bits that this version does not know.
TEST(ReadPlugin, takes_later_minor_versions) {
  PluginByHand hand;
  struct Later : clusterbench_method {
    std::uint64_t more = ~std::uint64_t{0};
  } later;
  static_cast<clusterbench_method&>(later) = hand.method;
  later.struct_size = sizeof later;
  later.flags |= 1u << 20;
  later.light_types |= 1u << 7;
  hand.methods[0] = &later;
  hand.plugin.minor = 7;
  EXPECT_EQ(read_plugin("hand.so", &hand.plugin).minor, 7u);
  EXPECT_EQ(read_plugin("hand.so", &hand.plugin).methods[0].unknown_needs, 0u);
  later.needs = 1u << 5 | CLUSTERBENCH_NEEDS_DEPTH;
  EXPECT_EQ(read_plugin("hand.so", &hand.plugin).methods[0].unknown_needs, 1u << 5);
}

struct Wrong {
  std::string what;
  std::function<void(PluginByHand&)> make;
};

const double k_nan = std::numeric_limits<double>::quiet_NaN();
const std::string k_long(2000, 'a');

const Wrong k_wrong[] = {
    {"is made for version 2.3 of the interface; this program takes versions 1.0 and later ones of 1",
     [](PluginByHand& hand) { hand.plugin.major = 2, hand.plugin.minor = 3; }},
    {"is made for version 0.0", [](PluginByHand& hand) { hand.plugin.major = 0; }},
    {"is no plug-in: its struct_size is 3; takes 48 to 65536", [](PluginByHand& hand) { hand.plugin.struct_size = 3; }},
    {"struct_size is 40; takes 48 to 65536", [](PluginByHand& hand) { hand.plugin.struct_size = 40; }},
    {"struct_size is 4294967295", [](PluginByHand& hand) { hand.plugin.struct_size = ~0u; }},
    {"id: is a null pointer", [](PluginByHand& hand) { hand.plugin.id = nullptr; }},
    {"id: is 'Hand'; takes lower-case letters", [](PluginByHand& hand) { hand.plugin.id = "Hand"; }},
    {"id: is 'a.b'", [](PluginByHand& hand) { hand.plugin.id = "a.b"; }},
    {"id: is '1a'", [](PluginByHand& hand) { hand.plugin.id = "1a"; }},
    {"id: is empty; takes a text of 1 to 64 bytes", [](PluginByHand& hand) { hand.plugin.id = ""; }},
    {"id: is longer than 64 bytes; takes a text of 1 to 64 bytes",
     [](PluginByHand& hand) { hand.plugin.id = k_long.c_str(); }},
    {"name: has a character that is none", [](PluginByHand& hand) { hand.plugin.name = "a\nb"; }},
    {"name: has a character that is none", [](PluginByHand& hand) { hand.plugin.name = "\xff"; }},
    {"version: is a null pointer", [](PluginByHand& hand) { hand.plugin.version = nullptr; }},
    {"method_count is 0; takes 1 to 64", [](PluginByHand& hand) { hand.plugin.method_count = 0; }},
    {"method_count is 65", [](PluginByHand& hand) { hand.plugin.method_count = 65; }},
    {"methods is a null pointer", [](PluginByHand& hand) { hand.plugin.methods = nullptr; }},
    {"method 0: is a null pointer", [](PluginByHand& hand) { hand.methods[0] = nullptr; }},
    {"method 0: struct_size is 12; takes 88", [](PluginByHand& hand) { hand.method.struct_size = 12; }},
    {"method 0, name: is 'a b'", [](PluginByHand& hand) { hand.method.name = "a b"; }},
    {"method 'cells', summary: is longer than 1000 bytes",
     [](PluginByHand& hand) { hand.method.summary = k_long.c_str(); }},
    {"method 'cells', source: is a null pointer", [](PluginByHand& hand) { hand.method.source = nullptr; }},
    {"method 'cells', create: is a null pointer", [](PluginByHand& hand) { hand.method.create = nullptr; }},
    {"method 'cells', build: is a null pointer", [](PluginByHand& hand) { hand.method.build = nullptr; }},
    {"method 'cells', assign: is a null pointer", [](PluginByHand& hand) { hand.method.assign = nullptr; }},
    {"method 'cells', destroy: is a null pointer", [](PluginByHand& hand) { hand.method.destroy = nullptr; }},
    {"method 'cells': grid_kinds has no kind of grid", [](PluginByHand& hand) { hand.method.grid_kinds = 16; }},
    {"method 'cells': light_types has no type of light", [](PluginByHand& hand) { hand.method.light_types = 0; }},
    {"method 'cells': says that it is exact, but not that it is conservative",
     [](PluginByHand& hand) { hand.method.flags = CLUSTERBENCH_EXACT; }},
    {"method 'cells': parameter_count is 65", [](PluginByHand& hand) { hand.method.parameter_count = 65; }},
    {"method 'cells': parameters is a null pointer", [](PluginByHand& hand) { hand.method.parameters = nullptr; }},
    {"has two methods 'hand.cells'",
     [](PluginByHand& hand) {
       hand.methods.push_back(&hand.method);
       hand.plugin.methods = hand.methods.data();
       hand.plugin.method_count = 2;
     }},
    {"parameter 1: is a null pointer", [](PluginByHand& hand) { hand.parameters[1] = nullptr; }},
    {"parameter 1: struct_size is 4; takes 88", [](PluginByHand& hand) { hand.number.struct_size = 4; }},
    {"parameter 1, name: is 'Size'", [](PluginByHand& hand) { hand.number.name = "Size"; }},
    {"parameter 'name': is no name for a parameter", [](PluginByHand& hand) { hand.number.name = "name"; }},
    {"has two parameters 'on'", [](PluginByHand& hand) { hand.number.name = "on"; }},
    {"parameter 'size', summary: is empty", [](PluginByHand& hand) { hand.number.summary = ""; }},
    {"parameter 'size': type is 9; takes 1 (flag), 2 (number) or 3 (text)",
     [](PluginByHand& hand) { hand.number.type = 9; }},
    {"parameter 'on': the default of a flag is 0 or 1", [](PluginByHand& hand) { hand.flag.default_number = 2; }},
    {"parameter 'size': min and max must be finite", [](PluginByHand& hand) { hand.number.max = INFINITY; }},
    {"parameter 'size': min and max must be finite", [](PluginByHand& hand) { hand.number.min = 9; }},
    {"parameter 'size': the default is not between min and max",
     [](PluginByHand& hand) { hand.number.default_number = k_nan; }},
    {"parameter 'size': the default is no whole number",
     [](PluginByHand& hand) {
       hand.number.flags = CLUSTERBENCH_PARAMETER_WHOLE;
       hand.number.default_number = 2.5;
     }},
    {"parameter 'size': counts threads: takes whole numbers from 1",
     [](PluginByHand& hand) { hand.number.flags = CLUSTERBENCH_PARAMETER_THREADS; }},
    {"parameter 'size': conservative_from is no finite number",
     [](PluginByHand& hand) { hand.number.conservative_from = k_nan; }},
    {"parameter 'size': conservative_from is not between min and max",
     [](PluginByHand& hand) { hand.number.conservative_from = 8.5; }},
    {"parameter 'size': conservative_from is not between min and max",
     [](PluginByHand& hand) { hand.number.conservative_from = 0.25; }},
    {"parameter 'size': the default is below conservative_from, but the method says that it is conservative",
     [](PluginByHand& hand) {
       hand.method.flags = CLUSTERBENCH_CONSERVATIVE;
       hand.number.conservative_from = 3.0;
     }},
    {"parameter 'way': choice_count is 0", [](PluginByHand& hand) { hand.text.choice_count = 0; }},
    {"parameter 'way': choices is a null pointer", [](PluginByHand& hand) { hand.text.choices = nullptr; }},
    {"parameter 'way', choice 1: is a null pointer", [](PluginByHand& hand) { hand.choices[1] = nullptr; }},
    {"parameter 'way', choice 1: 'fast' is there twice", [](PluginByHand& hand) { hand.choices[1] = "fast"; }},
    {"parameter 'way': the default 'other' is none of fast, slow",
     [](PluginByHand& hand) { hand.text.default_text = "other"; }},
};

TEST(ReadPlugin, refuses_each_fault_with_a_sentence_that_names_its_place) {
  for (const Wrong& wrong : k_wrong) {
    PluginByHand hand;
    wrong.make(hand);
    try {
      read_plugin("hand.so", &hand.plugin);
      ADD_FAILURE() << "takes a plug-in that " << wrong.what;
    } catch (const Error& error) {
      EXPECT_EQ(error.file(), "hand.so");
      EXPECT_NE(std::string(error.what()).find(wrong.what), std::string::npos) << error.what() << "\n" << wrong.what;
    }
  }
}

TEST(ReadPlugin, refuses_an_entry_that_returns_nothing) {
  EXPECT_THROW(read_plugin("hand.so", nullptr), Error);
}

}  // namespace
}  // namespace clusterbench::plugin::testing
