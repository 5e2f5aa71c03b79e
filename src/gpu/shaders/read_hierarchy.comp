#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"

// Two trees (points, spots) of boxes in groups of eight. Each level of a walk has the bits of a group that are left, so that
// no stack is needed: the parent of group g is g / 8. A wave walks the boxes that any of its lanes is in.
layout(std430, set = 0, binding = 5) readonly buffer Boxes { vec4 boxes[]; };   // of a group: low x, y, z, high x, y, z of eight
layout(std430, set = 0, binding = 6) readonly buffer Order { uint order[]; };   // the light of each box of level 0
layout(std430, set = 0, binding = 7) readonly buffer Trees { uint trees[]; };   // k_tree_words each: levels, first of order,
                                                                                // first group of each level
const uint k_trees = 2, k_tree_words = 10;  // 8 levels: gpu/reading/reading_structure.cpp

uint tree, level, group, own_leaves, last_bit;
uvec2 left;  // eight bits for each level
bool is_asking;

uint touched(uint at) {
  uint found = 0;
  vec3 p = sample_position;
  for (uint half_group = 0; half_group < 2; ++half_group) {
    uint box = 12 * at + half_group;
    for (uint i = 0; i < 4; ++i) {
      bool is_within = boxes[box][i] <= p.x && boxes[box + 6][i] >= p.x && boxes[box + 2][i] <= p.y &&
                       boxes[box + 8][i] >= p.y && boxes[box + 4][i] <= p.z && boxes[box + 10][i] >= p.z;
      found |= uint(is_within) << (4 * half_group + i);
    }
  }
  return found;
}

uint bits_left() { return (level < 4 ? left.x : left.y) >> 8 * (level & 3u) & 0xffu; }

void leave(uint bits) {
  uint shift = 8 * (level & 3u), kept = ~(0xffu << shift);
  if (level < 4)
    left.x = left.x & kept | bits << shift;
  else
    left.y = left.y & kept | bits << shift;
}

void enter(uint of_level, uint of_group) {
  level = of_level;
  group = of_group;
  uint own = is_asking ? touched(trees[tree * k_tree_words + 2 + level] + group) : 0;
  if (level == 0) own_leaves = own;
  leave(k_walking == k_by_light ? subgroupOr(own) : own);
}

// Of the first tree from this one on that has lights; false: there is none.
bool enter_tree(uint from) {
  for (tree = from; tree < k_trees; ++tree) {
    uint levels = trees[tree * k_tree_words];
    if (levels == 0) continue;
    enter(levels - 1, 0);
    return true;
  }
  return false;
}

void begin_walk(Place place) {
  is_asking = place.cell >= 0;
  left = uvec2(0);
  enter_tree(0);
}

uint next_light() {
  while (tree < k_trees) {
    uint bits = bits_left();
    if (bits == 0) {
      if (level == trees[tree * k_tree_words] - 1) {
        enter_tree(tree + 1);
      } else {
        ++level;
        group >>= 3;
      }
      continue;
    }
    last_bit = findLSB(bits);
    leave(bits & bits - 1);
    uint child = 8 * group + last_bit;
    if (level == 0) return order[trees[tree * k_tree_words + 1] + child];
    enter(level - 1, child);
  }
  return k_none;
}

#define WALKS_TOGETHER
void walk_together(Place place) {
  begin_walk(place);
  for (uint light = next_light(); light != k_none; light = next_light())
    if ((own_leaves >> last_bit & 1u) != 0) visit(light);
}

#include "read_walk.glsl"
