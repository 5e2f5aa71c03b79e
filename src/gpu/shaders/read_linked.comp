#version 460
#extension GL_GOOGLE_include_directive : require
#include "read.glsl"

// A head per cell; nodes of a light and the next node.
layout(std430, set = 0, binding = 5) readonly buffer Nodes { uvec2 nodes[]; };
layout(std430, set = 0, binding = 6) readonly buffer Heads { uint heads[]; };

uint node;

void begin_walk(Place place) { node = heads[place.cell]; }

uint next_light() {
  if (node == k_none) return k_none;
  uvec2 here = nodes[node];
  node = here.y;
  return here.x;
}

#include "read_walk.glsl"
