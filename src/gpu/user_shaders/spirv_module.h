#pragma once
// A module of SPIR-V from a file: what it is, and what it takes of bindings, arguments and devices. Read word by word,
// without Vulkan. Numbers are those of the SPIR-V specification, version 1.6.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clusterbench::gpu {

// A number of a block, as its module declares it.
struct BlockNumber {
  std::uint64_t at = 0;
  char kind = 'u';  // f, i, u
  std::uint32_t bytes = 4;
};

struct ModuleBinding {
  enum class Kind : std::uint8_t { storage, uniform, other };
  std::uint32_t set = 0, binding = 0;
  Kind kind = Kind::other;
  std::string name;                    // as the compiler left it; may be ""
  std::uint64_t bytes = 0;             // at least so many are read; of an array without an end its first element counts
  bool is_array = false;               // of buffers
  std::vector<BlockNumber> numbers{};  // of the first 4096 bytes, ascending
};

struct ModuleConstant {
  std::uint32_t id = 0;
  bool is_word = false;  // 32 bits, or a truth value
  std::string type{};    // u32, i32, f32, bool; "" where it is another, or not the same everywhere
};

struct ModuleEntry {
  std::string name;
  bool is_compute = false;
  std::array<std::uint32_t, 3> size_ids{};  // of constants; 0: literal
  std::array<std::uint32_t, 3> size{1, 1, 1};
};

struct SpirvModule {
  std::vector<std::uint32_t> words;
  std::uint32_t version = 0;  // 0x00010600
  std::vector<ModuleEntry> entries;
  std::vector<ModuleBinding> bindings;
  std::vector<ModuleConstant> constants;  // that can be specialized
  std::vector<std::uint32_t> capabilities;
  std::uint64_t argument_bytes = 0;  // of push constants
  // The bytes of push constants that are members, not gaps; none where entries have blocks of their own.
  std::vector<bool> arguments;
  std::vector<BlockNumber> argument_numbers;  // ascending; none where `arguments` are none
  // Does it take bits of other numbers for floats, for whole ones?
  bool casts_to_float = false, casts_to_whole = false;
  std::uint64_t shared_bytes = 0;  // of a group, with the module's own constants

  // Of an entry, with constants by id in place of the module's own; nullopt where a size is computed.
  std::optional<std::array<std::uint32_t, 3>> group_size(const ModuleEntry& entry,
                                                         const std::map<std::uint32_t, std::uint32_t>& given) const;

  struct Number {
    std::uint32_t value = 0;
    std::optional<std::uint32_t> specialized_as{};
  };
  std::map<std::uint32_t, Number> numbers;  // constants of 32 bits, by result
};

// Throws Error (file, byte) with one sentence for bytes that are no such module, or, where the build has SPIRV-Tools,
// that break its rules.
SpirvModule read_module(std::span<const std::byte> bytes, const std::string& file);

}  // namespace clusterbench::gpu
