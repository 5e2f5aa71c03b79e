#include "gpu/vulkan/shader_needs.h"

namespace clusterbench::gpu {
namespace {

// Numbers of the SPIR-V specification.
constexpr std::uint32_t k_capability = 17, k_decorate = 71;   // instructions
constexpr std::uint32_t k_arithmetic = 63, k_ballot = 64;     // capabilities
constexpr std::uint32_t k_built_in = 11, k_subgroup_id = 40;  // a decoration; a variable with it
constexpr std::size_t k_header_words = 5;

}  // namespace

Needs needs_of(std::span<const std::uint32_t> code) {
  Needs needs;
  for (std::size_t at = k_header_words; at < code.size();) {
    const std::uint32_t instruction = code[at] & 0xffffu, words = code[at] >> 16;
    if (words == 0 || at + words > code.size()) break;
    if (instruction == k_capability) {
      needs.ballots |= code[at + 1] == k_ballot;
      needs.subgroup_arithmetic |= code[at + 1] == k_arithmetic;
    }
    // Who numbers invocations by subgroup counts on none being left out.
    if (instruction == k_decorate && words > 3 && code[at + 2] == k_built_in)
      needs.full_subgroups |= code[at + 3] == k_subgroup_id;
    at += words;
  }
  return needs;
}

}  // namespace clusterbench::gpu
