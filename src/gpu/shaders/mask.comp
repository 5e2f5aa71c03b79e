#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "common.glsl"

// One group per cell and 64 lights, an invocation for each light; a ballot makes the cell's bits. Invocations are numbered
// by subgroup, since nothing else says which of them a ballot's bit belongs to. A subgroup that is wider than the group is
// not full, and which of its invocations are there is not said: then each sets its own bit.
shared uint bits[2];

#ifdef REVERSED_LANES  // tests have no device that is as wide
const uint k_widest = 0;
#else
const uint k_widest = 64;
#endif

void main() {
  uint pairs_of_words = (frame.words + 1) / 2;
  uint group = group_index(), index = group / pairs_of_words, word = 2 * (group % pairs_of_words);
  if (index >= frame.cells) return;  // the whole group
  uint slot = lane_index();
  if (slot < 2) bits[slot] = 0;
  barrier();
  bool is_full = gl_SubgroupSize <= k_widest;
  uint first = gl_SubgroupID * gl_SubgroupSize, lane = is_full ? first + gl_SubgroupInvocationID : slot;
  uint light = 32 * word + lane;
  bool hit = light < frame.lights && touches(light, balls[light], cell_of(index));
  uvec4 ballot = subgroupBallot(hit);
  if (!is_full) {
    if (hit) atomicOr(bits[lane / 32], 1u << (lane % 32));
  } else if (subgroupElect()) {
    if (gl_SubgroupSize <= 32) {
      atomicOr(bits[first / 32], ballot.x << (first % 32));
    } else {
      bits[0] = ballot.x;
      bits[1] = ballot.y;
    }
  }
  barrier();
  if (slot < 2 && word + slot < frame.words) masks[index * frame.words + word + slot] = bits[slot];
}
