// What is read of modules, and of what is none.

#include "gpu/user_shaders/spirv_module.h"

#include <algorithm>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file_text.h"
#include "effort.h"
#include "gpu/user_shaders/capability_names.h"
#include "places.h"

namespace clusterbench::gpu {
namespace {

std::string module_bytes(const char* name) {
  return file_text(test::source_dir() + "/configs/shaders/" + name + ".spv");
}
SpirvModule module_of(const std::string& bytes) {
  return read_module(std::as_bytes(std::span(bytes)), "x.spv");
}
std::string refusal_of_module(const std::string& bytes) {
  try {
    module_of(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SpirvModules, tell_their_entry_bindings_and_groups) {
  const SpirvModule module = module_of(module_bytes("tutorial_cull"));
  ASSERT_EQ(module.entries.size(), 1u);
  EXPECT_EQ(module.entries[0].name, "main");
  EXPECT_TRUE(module.entries[0].is_compute);
  EXPECT_EQ(module.group_size(module.entries[0], {}), (std::array<std::uint32_t, 3>{128, 1, 1}));
  ASSERT_EQ(module.bindings.size(), 3u);
  std::uint64_t frame_bytes = 0, cell_bytes = 0, light_bytes = 0;
  for (const ModuleBinding& binding : module.bindings) {
    EXPECT_FALSE(binding.is_array);
    if (binding.set == 0 && binding.binding == 1) {
      EXPECT_EQ(binding.kind, ModuleBinding::Kind::uniform);
      frame_bytes = binding.bytes;
    } else {
      EXPECT_EQ(binding.kind, ModuleBinding::Kind::storage);
      (binding.set == 1 ? light_bytes : cell_bytes) = binding.bytes;
    }
  }
  EXPECT_EQ(frame_bytes, 160u);
  EXPECT_EQ(cell_bytes, 36u + 400u);
  EXPECT_EQ(light_bytes, 40u);
  EXPECT_EQ(module.argument_bytes, 0u);
  EXPECT_EQ(module.capabilities, std::vector<std::uint32_t>{1});
}

TEST(SpirvModules, tell_push_constants_and_what_can_be_specialized) {
  const SpirvModule module = module_of(module_bytes("append"));
  EXPECT_EQ(module.argument_bytes, 20u);
  EXPECT_EQ(module.shared_bytes, 12u);
  ASSERT_EQ(module.constants.size(), 1u);
  EXPECT_EQ(module.constants[0].id, 0u);
  EXPECT_TRUE(module.constants[0].is_word);
  EXPECT_EQ(module.constants[0].type, "u32");
  EXPECT_EQ(module.arguments, std::vector<bool>(20, true));
  EXPECT_EQ(module.group_size(module.entries[0], {{0, 96}}), (std::array<std::uint32_t, 3>{96, 1, 1}));
}

TEST(SpirvModules, tell_the_types_of_the_numbers_in_their_blocks) {
  const SpirvModule module = module_of(module_bytes("append"));
  ASSERT_EQ(module.argument_numbers.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(module.argument_numbers[i].at, 4 * i);
    EXPECT_EQ(module.argument_numbers[i].kind, 'u');
    EXPECT_EQ(module.argument_numbers[i].bytes, 4u);
  }
  for (const ModuleBinding& binding : module.bindings) {
    ASSERT_FALSE(binding.numbers.empty());
    EXPECT_EQ(binding.numbers.front().kind, binding.binding < 3 ? 'f' : 'u') << binding.binding;
  }
}

TEST(SpirvModules, name_the_capabilities_that_they_declare) {
  EXPECT_EQ(capability_name(6033), "AtomicFloat32AddEXT");
  EXPECT_EQ(capability_name(4472), "RayQueryKHR");
  EXPECT_EQ(capability_name(99999), "number 99999");
  EXPECT_TRUE(is_capability_asked_for(10));
  EXPECT_FALSE(is_capability_asked_for(6033));
}

TEST(SpirvModules, that_are_none_are_refused_in_one_sentence) {
  const std::string good = module_bytes("append");
  std::string swapped = good;
  for (std::size_t i = 0; i < swapped.size(); i += 4) std::reverse(swapped.begin() + i, swapped.begin() + i + 4);
  std::string newer = good;
  newer[5] = 7;
  newer[6] = 1;
  EXPECT_NE(refusal_of_module("").find("is no SPIR-V: 0 bytes"), std::string::npos);
  EXPECT_NE(refusal_of_module(good.substr(0, good.size() - 1)).find("is no SPIR-V"), std::string::npos);
  EXPECT_NE(refusal_of_module("#version 450\nvoid main() {}\n").find("is GLSL"), std::string::npos);
  EXPECT_NE(refusal_of_module(std::string(64, 'x')).find("begins with 03 02 23 07"), std::string::npos);
  EXPECT_NE(refusal_of_module(swapped).find("other byte order"), std::string::npos);
  EXPECT_NE(refusal_of_module(newer).find("version 1.7"), std::string::npos);
  EXPECT_EQ(refusal_of_module(good), "");
}

TEST(SpirvModules, that_are_cut_off_anywhere_are_refused) {
  const std::string good = module_bytes("append");
  std::size_t refused = 0, words = 0;
  for (std::size_t size = 20; size < good.size(); size += 4, ++words)
    refused += refusal_of_module(good.substr(0, size)).empty() ? 0 : 1;
  EXPECT_GT(refused, words / 2);  // all, where the build has SPIRV-Tools
}

// Each struct has the one before it a thousand times, and the last itself.
TEST(SpirvModules, with_types_that_grow_without_end_are_measured_at_once) {
  std::vector<std::uint32_t> words{0x07230203u, 0x00010000u, 0, 1000, 0, 3u << 16 | 22u, 1, 32};
  const auto add = [&](std::uint32_t op, std::vector<std::uint32_t> operands) {
    words.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | op);
    words.insert(words.end(), operands.begin(), operands.end());
  };
  for (std::uint32_t id = 2; id < 60; ++id) {
    std::vector<std::uint32_t> members(1001, id == 59 ? id : id - 1);
    members[0] = id;
    add(30, members);
  }
  add(32, {100, 4, 58});
  add(59, {100, 101, 4});
  add(32, {102, 9, 59});
  add(59, {102, 103, 9});
  const std::string bytes(reinterpret_cast<const char*>(words.data()), words.size() * 4);
  refusal_of_module(bytes);  // by the rules, where the build knows them
}

TEST(SpirvModules, with_words_changed_by_chance_never_end_the_process) {
  const std::string good = module_bytes("append");
  std::mt19937 random(7);
  const int tries = test::tries(20000);
  int refused = 0;
  for (int i = 0; i < tries; ++i) {
    std::string changed = good;
    for (int j = 0; j < 1 + i % 3; ++j) {
      const std::uint32_t word = i % 2 == 0 ? random() : 1u << random() % 32;
      const std::size_t at = 4 * (1 + random() % (good.size() / 4 - 1));
      std::memcpy(changed.data() + at, &word, 4);
    }
    refused += refusal_of_module(changed).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, tries / 4);
}

}  // namespace
}  // namespace clusterbench::gpu
