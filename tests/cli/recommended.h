#pragma once
// Answers of `recommend` on a small space of candidates, and all its cases on all frames to compare them with.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/tool.h"

namespace clusterbench::test::recommending {

using Json = nlohmann::json;

// 52 candidates on 8 frames.
inline std::string space(const std::string& more = "") {
  return R"({"name": "space", "scenes": [{"path": ")" + source_file("scenes/street.glb") + R"(", "frames": 8}],
    "viewport": [640, 360],
    "grids": [{"kind": "frustum", "tiles": {"pixels": [32, 64, 128]},
               "slices": {"scheme": ["exponential", "exponential-first"], "count": [4, 8]}},
              {"kind": "world", "cells": [[16, 4, 16], [32, 8, 32]]}],
    "assigners": ["aabb-fast", "exact-fast", "world-grid-fast"], "storages": ["packed", "bitfield"],
    "shading": {"samples": 256}, "timing": {"sweep_mib": 4, "rounds": 2, "min_time_ms": 0.2, "frames": 2, "launches": 2})" +
         more + "}";
}

struct Recommended {
  Outcome outcome;
  Json answer;
};
inline Recommended recommended(const std::string& config, const std::string& flags) {
  const Folder folder;
  const std::string input = folder.write("space.json", config).string(), output = (folder / "answer.json").string();
  Recommended found{tool("recommend " + input + " -q -o " + output + " " + flags), Json()};
  if (!std::filesystem::exists(output)) return found;
  const Outcome valid = tool("validate " + output);
  EXPECT_EQ(valid.code, 0) << valid.err;
  found.answer = Json::parse(file_text(output))["answers"][0];
  return found;
}

// Every case of the space on every frame.
inline Json swept(const std::string& config) {
  const Folder folder;
  const std::string input = folder.write("space.json", config).string(), output = (folder / "result.json").string();
  const Outcome done = tool("run " + input + " -q --no-timing -o " + output);
  EXPECT_EQ(done.code, 0) << done.err;
  return Json::parse(file_text(output))["cases"];
}

inline bool is_lit(const Json& one) {
  return one["failures"].empty() && one["error"]["false_negatives"] == 0 && one["shading"]["missed"] == 0 &&
         one["buffers"]["overflow"]["dropped_pairs"] == 0;
}

inline double figure(const Json& one, const std::string& name) {
  if (name == "bytes") return one["buffers"]["bytes"]["high_water"];
  if (name == "index_entries") return one["buffers"]["index_entries"]["high_water"];
  if (name == "longest") return one["occupancy"]["lights_per_cell"]["max"];
  return one["shading"]["evaluated"].get<double>() / one["shading"]["samples"].get<double>();
}

}  // namespace clusterbench::test::recommending
