#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// One light before the camera in a grid of two cells, with its lists in buffers.
struct Small {
  Folder folder;
  Json dump = Json::parse(R"({
    "dump_version": 1, "viewport": [64, 64],
    "buffers": {"cells": {"file": "cells.bin"}, "indices": {"file": "indices.bin"}, "lights": {"file": "lights.bin"}},
    "camera": {"world_to_view": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1],
               "sides": [-1, 1, -1, 1], "near_m": 1, "far_m": 100},
    "grid": {"tiles": {"count": [1, 1]}, "slices": {"boundaries_m": [1, 10, 100]}},
    "lights": {"rows": [{"buffer": "lights", "stride": 16, "count": 1,
                         "position": {"at": 0, "type": "f32"}, "range": {"at": 12, "type": "f32"}}]},
    "lists": [{"layout": "packed", "rows": {"buffer": "cells", "stride": 4},
               "offset": {"at": 0, "type": "u16"}, "counts": [{"at": 2, "type": "u16"}],
               "entries": {"buffer": "indices", "type": "u16"}}]})");

  Small() {
    write<std::uint16_t>("cells.bin", {0, 1, 1, 1});
    write<std::uint16_t>("indices.bin", {0, 0});
    write<float>("lights.bin", {0.0f, 0.0f, -9.0f, 2.0f});
  }
  template <class T>
  void write(const std::string& name, const std::vector<T>& values) {
    folder.write(name, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
  std::string path() const { return folder.write("dump.json", dump.dump()).string(); }
  Outcome check(const std::string& flags = "--methods none") const { return tool("check " + path() + " " + flags); }
};

TEST(Check, right_lists_pass_and_a_lost_light_fails_with_its_cell_and_how_far_it_reaches_in) {
  Small small;
  const Outcome right = small.check();
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_NE(right.out.find("lists: right: no light is lost"), std::string::npos) << right.out;
  small.write<std::uint16_t>("cells.bin", {0, 1, 1, 0});
  const Outcome lost = small.check("--methods none --json " + (small.folder / "out.json").string());
  EXPECT_EQ(lost.code, 1);
  EXPECT_NE(
      lost.out.find("light 0, cell (0, 0, 1) (number 1, depth 10 to 100 m): reaches in by 1 m, 50 % of its range"),
      std::string::npos)
      << lost.out;
  const Json found = Json::parse(file_text(small.folder / "out.json"));
  EXPECT_EQ(found["verdict"], "lost");
  EXPECT_EQ(found["frames"][0]["sets"][0]["error"]["lost_pairs"], 1);
  EXPECT_NEAR(found["frames"][0]["sets"][0]["lost"][0]["reach_mm"].get<double>(), 1000.0, 1e-3);
  const std::string out = (small.folder / "out.json").string();
  EXPECT_EQ(tool("validate " + out).out, out + ": valid, a verdict of `clusterbench check` with 1 frame\n");
  EXPECT_EQ(tool("validate " + small.path()).code, 0);
  const Outcome quiet = small.check("-q");
  EXPECT_EQ(quiet.code, 1);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Check, buffers_that_are_no_lists_are_told_with_their_bytes_and_the_likeliest_reading) {
  Small small;
  small.write<std::uint32_t>("indices.bin", {0, 0});
  small.dump["lists"][0]["entries"]["type"] = "u16";
  small.dump["lights"]["rows"][0]["count"] = 1;
  small.write<std::uint16_t>("indices.bin", {0, 7});
  const Outcome done = small.check();
  EXPECT_EQ(done.code, 1);
  EXPECT_NE(done.out.find("these are no lists: 1 value cannot be right"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("buffer 'indices', byte 2: index 7 is not below the 1 light, in cell (0, 0, 1)"),
            std::string::npos)
      << done.out;
  EXPECT_NE(done.out.find("with entries as u8 all 2 indices are below 1"), std::string::npos) << done.out;
}

TEST(Check, what_is_bad_in_a_dump_is_one_line_with_file_and_place) {
  using Change = std::function<void(Small&)>;
  const std::pair<Change, const char*> rows[] = {
      {[](Small& s) { s.dump["dump_version"] = 2; }, "dump.json: /dump_version: is 2; this version reads 1"},
      {[](Small& s) { s.dump.erase("dump_version"); }, "dump.json: /dump_version: is missing: this is no dump"},
      {[](Small& s) { s.dump["viewprt"] = 1; }, "dump.json: /viewprt: is not known"},
      {[](Small& s) {
         s.dump["viewport"] = {0, 64};
       },
       "dump.json: /viewport/0: is 0; allowed: at least 1"},
      {[](Small& s) { s.dump["lists"] = Json::array(); }, "dump.json: /lists: has 0 elements; allowed: at least 1"},
      {[](Small& s) { s.dump["lists"][0]["layout"] = "packd"; },
       "dump.json: /lists/0/layout: found 'packd' (did you mean 'packed'?), allowed: packed, fixed"},
      {[](Small& s) { s.dump["lists"][0]["rows"]["stride"] = -1; },
       "dump.json: /lists/0/rows/stride: must be a whole number of at least 0"},
      {[](Small& s) { s.dump["buffers"]["cells"]["file"] = "none.bin"; }, "dump.json: /buffers/cells/file: names "},
      {[](Small& s) { s.dump["buffers"]["cells"]["file"] = ""; },
       "dump.json: /buffers/cells/file: is empty; allowed: the name of a file"},
      {[](Small& s) { s.dump["buffers"]["cells"]["file"] = std::string("a\0b", 3); },
       "dump.json: /buffers/cells/file: has a character 0 in it; allowed: the name of a file"},
      {[](Small& s) { s.dump["buffers"]["cells"]["file"] = "."; }, ", which is a folder, not a file"},
      {[](Small& s) {
         fs::create_symlink("loop.bin", s.folder / "loop.bin");
         s.dump["buffers"]["cells"]["file"] = "loop.bin";
       },
       "loop.bin, which is a link that leads nowhere"},
      {[](Small& s) { s.dump["buffers"]["cells"]["at"] = 9; },
       "dump.json: /buffers/cells/at: is 9; cells.bin has 8 bytes"},
      {[](Small& s) { s.dump["buffers"]["cells"]["bytes"] = 18446744073709551615ull; },
       "dump.json: /buffers/cells/bytes: is 18446744073709551615 from byte 0 on; cells.bin has 8 bytes"},
      {[](Small& s) { s.dump["lights"]["rows"][0]["count"] = 4000000000000ull; },
       "dump.json: /lights/rows/0: 4000000000000 lights, 16 bytes apart from byte 0, do not fit into buffer 'lights'"},
      {[](Small& s) { s.dump["lights"]["rows"][0]["count"] = 0; },
       "dump.json: /lights: are none, so there is nothing to check"},
      {[](Small& s) {
         s.write<float>("lights.bin", {0.0f, NAN, 0.0f, 1.0f});
       },
       "lights.bin: byte 0: light 0 has a position that is no number, or beyond 1e15 m"},
      {[](Small& s) {
         s.write<float>("lights.bin", {0.0f, 0.0f, 0.0f, -1.0f});
       },
       "lights.bin: byte 12: light 0 has a range that is no number, or below 0"},
      {[](Small& s) { s.dump["camera"]["world_to_view"][0] = 0; },
       "dump.json: /camera/world_to_view: is singular: its axes lie in one plane"},
      {[](Small& s) {
         s.dump["grid"]["slices"]["boundaries_m"] = {1, 10, 10};
       },
       "dump.json: /grid/slices/boundaries_m: do not ascend: 10 m is followed by 10 m (slice 1)"},
      {[](Small& s) {
         s.dump["grid"]["slices"] = {{"count", 2},
                                     {"formula", {{"function", "linear"}, {"scale", 0.1}, {"bias", 0}, {"far_m", 2}}}};
       },
       "dump.json: /grid/slices/formula/far_m: gives boundaries of slices that do not ascend: 10 m is followed by 2 m"},
      {[](Small& s) {
         s.dump["grid"]["slices"] = {{"count", 2}, {"formula", {{"function", "log2"}, {"scale", 1}, {"bias", 1e300}}}};
       },
       "dump.json: /grid/slices/formula: gives boundaries of slices that do not ascend: 0 m is followed by 0 m"},
      {[](Small& s) {
         s.dump["grid"]["slices"] = {{"count", 2},
                                     {"formula", {{"function", "linear"}, {"scale", 1e-300}, {"bias", 0}}}};
       },
       "dump.json: /grid/slices/formula: "},
      {[](Small& s) {
         s.dump["grid"]["slices"] = {{"scheme", "linear"}, {"count", 4}, {"near_m", 200}};
       },
       "dump.json: /grid/slices/near_m: "},
      {[](Small& s) { s.dump["camera"]["far_m"] = 0; },
       "dump.json: /camera/far_m: leaves the near plane at 1 m and the far plane at 0 m; allowed: near_m above 0 and "
       "below far_m"},
      {[](Small& s) {
         s.dump["grid"]["tiles"]["count"] = {65, 1};
       },
       "dump.json: /grid/tiles/count: gives 65 tiles along 64 pixels; at most one tile per pixel"},
      {[](Small& s) {
         s.dump["grid"]["slices"] = {{"scheme", "exponential-first"}, {"count", 4}};
       },
       "dump.json: /grid/slices/first_m: is missing: exponential-first needs it"},
      {[](Small& s) { s.dump["grid"]["axes"] = "xy"; }, "dump.json: /grid/axes: found 'xy'"},
      {[](Small& s) {
         s.dump["viewport"] = {65536, 65536};
         s.dump["grid"]["tiles"]["count"] = {65536, 65536};
       },
       "dump.json: /grid: its cells are more than 10^9: 65536x65536x2"},
      {[](Small& s) {
         s.dump["grid"]["tiles"]["count"] = {64, 64};
       },
       "dump.json: /lists/0/rows: 8192 rows, 4 bytes apart from byte 0, do not fit into buffer 'cells' of 8 bytes, "
       "which "
       "has room for 2"},
  };
  for (const auto& [change, wanted] : rows) {
    Small small;
    change(small);
    const Outcome done = small.check();
    EXPECT_EQ(done.code, 2) << wanted << done.out;
    EXPECT_NE(done.err.find(wanted), std::string::npos) << done.err;
    EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
  }
  const Small small;
  EXPECT_EQ(tool("check " + small.folder.write("half.json", "{\"dump_version\": 1,").string()).code, 2);
  EXPECT_NE(tool("check " + small.folder.path().string()).err.find("half.json: byte "), std::string::npos);
  EXPECT_EQ(tool("check /nowhere.json").err, "clusterbench: /nowhere.json: does not exist\n");
  EXPECT_EQ(tool("check").err, "clusterbench: DUMP: is required, or --template ENGINE for a dump to fill in\n");
}

TEST(Check, a_dump_that_is_cut_off_is_never_left_out_of_its_folder_and_other_files_are) {
  Small small;
  small.path();
  const std::string folder = small.folder.path().string();
  small.folder.write("schema.json", R"({"properties": {"dump_version": {"const": 1}}})");
  fs::create_symlink(small.folder / "nowhere", small.folder / ".#lock.json");
  EXPECT_EQ(tool("check --methods none " + folder).code, 0);
  fs::create_symlink(small.folder / "nowhere", small.folder / "moved.json");
  const Outcome dangling = tool("check --methods none " + folder);
  EXPECT_EQ(dangling.code, 2) << dangling.out;
  EXPECT_NE(dangling.err.find("moved.json: is a link that leads nowhere"), std::string::npos) << dangling.err;
  fs::remove(small.folder / "moved.json");
  for (const char* cut : {"", "{\"dump_ver"}) {
    const std::string path = small.folder.write("second.json", cut).string();
    const Outcome outcome = tool("check --methods none " + folder);
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_NE(outcome.err.find("second.json"), std::string::npos) << outcome.err;
  }
}

TEST(Check, no_output_goes_over_a_dump_or_its_buffers) {
  Small small;
  const std::string dump = small.path(), folder = small.folder.path().string();
  for (const std::string& input : {dump, folder})
    for (const char* file : {"dump.json", "cells.bin", "lights.bin"})
      for (const char* flag : {" --json ", " --page "}) {
        const std::string before = file_text(small.folder / file);
        const Outcome outcome = tool("check -q --methods none " + input + flag + (small.folder / file).string());
        EXPECT_EQ(outcome.code, 2) << input << " " << file;
        EXPECT_NE(outcome.err.find("would be lost"), std::string::npos) << outcome.err;
        EXPECT_EQ(file_text(small.folder / file), before);
      }
}

TEST(Check, the_other_convention_of_depth_is_said_where_it_fits) {
  Small small;
  // From -1 to 1 the near plane is at 0.1 m; from 0 to 1 it would be at 0.2 m.
  small.dump["camera"] = Json::parse(R"({"world_to_view": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1],
      "projection": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, -1.002002002002002, -1,  0, 0, -0.2002002002002002, 0],
      "depth": "-1..1"})");
  small.dump["grid"] = {{"tiles", {{"count", {1, 1}}}}, {"slices", {{"scheme", "exponential"}, {"count", 24}}}};
  small.dump["lights"] = {{"listed", Json::array()}};
  small.dump["lists"] = {{{"layout", "inline"}, {"cells", Json::array()}}};
  for (int slice = 0; slice < 24; ++slice) {  // a light in the middle of each slice
    const double depth = 0.1 * std::pow(1000.0, (slice + 0.5) / 24.0);
    small.dump["lights"]["listed"].push_back({{"position", {0, 0, -depth}}, {"range_m", 0.01 * depth}});
    small.dump["lists"][0]["cells"].push_back({slice});
  }
  EXPECT_EQ(small.check().code, 0) << small.check().out;
  small.dump["camera"]["depth"] = "0..1";
  const Outcome other = small.check();
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.out.find("with camera.depth '-1..1'"), std::string::npos) << other.out;
}

TEST(Check, keys_that_a_layout_does_not_read_and_grids_without_slices_are_refused) {
  Small keys, slices;
  keys.dump["lists"][0]["per_cell"] = 4;
  EXPECT_NE(keys.check().err.find("dump.json: /lists/0/per_cell: has no meaning with layout 'packed'; it is of fixed"),
            std::string::npos)
      << keys.check().err;
  EXPECT_EQ(tool("validate " + keys.path()).code, 2);
  slices.dump["grid"].erase("slices");
  EXPECT_NE(slices.check().err.find("dump.json: /grid/slices: are missing; allowed: boundaries_m, scheme or formula"),
            std::string::npos)
      << slices.check().err;
}

TEST(Check, a_page_has_the_name_of_one_and_folders_within_a_folder_are_not_read) {
  const Small small;
  const Outcome page = small.check("--page " + (small.folder / "page.txt").string());
  EXPECT_EQ(page.code, 2);
  EXPECT_NE(page.err.find("--page: is '"), std::string::npos) << page.err;
  EXPECT_FALSE(fs::exists(small.folder / "page.txt"));
  const Folder outer;
  fs::create_directory(outer / "sub");
  fs::copy_file(small.path(), outer / "sub" / "dump.json");
  const Outcome folder = tool("check " + outer.path().string());
  EXPECT_EQ(folder.code, 2);
  EXPECT_NE(folder.err.find("(folders within it are not read)"), std::string::npos) << folder.err;
}

TEST(Check, runs_of_more_lights_than_there_are_take_no_memory) {
  Small small;
  constexpr std::uint16_t k_lights = 50000;
  small.dump["lights"]["rows"][0]["count"] = k_lights;
  small.folder.write("lights.bin", std::string(std::size_t{16} * k_lights, '\0'));
  small.dump["lists"][0]["layout"] = "runs";
  small.write<std::uint16_t>("cells.bin", {0, k_lights, 0, 0});
  std::vector<std::uint16_t> runs;  // each over all lights: 2.5 billion in one cell
  for (int run = 0; run < k_lights; ++run) runs.insert(runs.end(), {0, k_lights - 1});
  small.write<std::uint16_t>("indices.bin", runs);
  const Outcome outcome = small.check();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("the cell has more lights than the 50000 lights of its part"), std::string::npos)
      << outcome.out;
}

TEST(Check, large_files_are_refused_before_they_are_read) {
  const Small small;
  const fs::path large = small.folder.write("large.json", "{");
  fs::resize_file(large, std::uint64_t{2} << 30);
  EXPECT_NE(tool("check " + large.string()).err.find("large.json: has 2147483648 bytes; a dump's JSON has at most"),
            std::string::npos);
  fs::remove(large);
  fs::resize_file(small.folder / "cells.bin", std::uint64_t{5} << 30);
  EXPECT_NE(small.check().err.find("/buffers/cells: has 5368709120 bytes: with it the buffers take more than 4096 MiB"),
            std::string::npos);
}

TEST(Check, the_lists_of_a_run_come_back_right_in_every_storage) {
  const Folder folder;
  const std::string dumps = (folder / "dumps").string();
  const Outcome written = tool(
      "run " + source_file("scenes/street.glb") + " --assigner exact-fast --grid frustum --tiles 96 --slices 8 " +
      "--set 'storages=[\"packed\",\"fixed\",\"bitfield\",\"linked\",\"runs\"]' --dump-frames 2 --write-dump " + dumps);
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_NE(written.err.find("10 dumps written"), std::string::npos) << written.err;
  const Outcome done = tool("check " + dumps + " --json " + (folder / "out.json").string());
  EXPECT_EQ(done.code, 0) << done.out;
  const Json found = Json::parse(file_text(folder / "out.json"));
  ASSERT_EQ(found["frames"].size(), 10u);
  for (const Json& frame : found["frames"]) {
    EXPECT_EQ(frame["sets"][0]["verdict"], "right") << frame["name"];
    EXPECT_EQ(frame["sets"][0]["error"]["false_positives"], 0) << frame["name"];
    for (const Json& method : frame["methods"]) EXPECT_EQ(method["lost_pairs"], 0) << method["name"];
    EXPECT_GE(frame["methods"].size(), 5u);
  }
}

TEST(Check, the_lists_of_world_grids_come_back_right_and_grids_without_words_stop_no_others) {
  const Folder folder;
  const std::string dumps = (folder / "dumps").string();
  const std::string config = folder
                                 .write("grids.json", R"({"scenes": [")" + source_file("scenes/street.glb") + R"("],
      "assigners": ["exact-fast", "world-grid-fast", "cascades-fast"],
      "grids": [{"kind": "cascades"}, {"kind": "frustum", "tiles": {"count": [8, 6]}, "slices": {"count": 6}},
                {"kind": "world", "cells": [12, 4, 12]},
                {"kind": "world", "cells": [9, 3, 8], "follow": "camera", "cell_size": [3.3, null, 3.1]}]})")
                                 .string();
  const Outcome written = tool("run " + config + " --dump-frames 2 --write-dump " + dumps);
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_NE(written.err.find("6 dumps written"), std::string::npos) << written.err;
  EXPECT_NE(written.err.find("no dump: dumps have no words for grids of kind cascades"), std::string::npos)
      << written.err;
  const Outcome done = tool("check --methods none " + dumps + " --json " + (folder / "out.json").string());
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  const Json found = Json::parse(file_text(folder / "out.json"));
  ASSERT_EQ(found["frames"].size(), 6u);
  std::size_t of_world = 0;
  for (const Json& frame : found["frames"]) {
    EXPECT_EQ(frame["sets"][0]["verdict"], "right") << frame["name"];
    of_world += frame["grid_kind"] == "world";
  }
  EXPECT_EQ(of_world, 4u);
  const Outcome none = tool("run " + config + " --filter cascades --write-dump " + (folder / "none").string());
  EXPECT_EQ(none.code, 2) << none.err;
  EXPECT_NE(none.err.find("--write-dump: has written no dump; "), std::string::npos) << none.err;
}

TEST(Check, methods_are_those_that_are_asked_for) {
  const Small small;
  const std::string json = (small.folder / "out.json").string();
  const auto names = [&](const std::string& flags) {
    EXPECT_EQ(small.check(flags + " --json " + json).code, 0);
    std::vector<std::string> out;
    const Json found = Json::parse(file_text(json));
    for (const Json& method : found["frames"][0]["methods"]) out.push_back(method["name"]);
    return out;
  };
  EXPECT_EQ(names("--methods none"), std::vector<std::string>{});
  EXPECT_EQ(names("--methods exact,aabb-fast"), (std::vector<std::string>{"exact", "aabb-fast"}));
  EXPECT_EQ(names("--methods all"), names(""));
  const std::pair<const char*, const char*> bad[] = {
      {"--methods exct", "--methods: found 'exct' (did you mean 'exact'?), allowed: none, quick, all, or names"},
      {"--methods world-grid", "--methods: names 'world-grid', which makes no lists of this dump's grid"},
      {"--methods exact,exact", "--methods: names 'exact' twice; allowed: each method once"},
      {"--methods tiled",
       "--methods: names 'tiled', which makes no lists of this dump's grid on a processor; allowed: "}};
  for (const auto& [flags, wanted] : bad) {
    const Outcome refused = small.check(flags);
    EXPECT_EQ(refused.code, 2) << flags;
    EXPECT_NE(refused.err.find(wanted), std::string::npos) << refused.err;
  }
}

TEST(Check, without_names_of_lost_lights_it_speaks_of_none) {
  Small small;
  small.write<std::uint16_t>("cells.bin", {0, 1, 1, 0});
  const Outcome none = small.check("--methods none --most-lost 0"), one = small.check();
  EXPECT_EQ(none.code, 1);
  EXPECT_EQ(none.out.find(" more\n"), std::string::npos) << none.out;
  EXPECT_EQ(none.out.find("first cell above"), std::string::npos) << none.out;
  EXPECT_NE(one.out.find("first cell above"), std::string::npos) << one.out;
}

TEST(Check, lists_that_a_storage_cuts_off_are_told_when_they_are_written_and_when_they_are_checked) {
  const Folder folder;
  const std::string dumps = (folder / "dumps").string(),
                    run = "run " + source_file("scenes/street.glb") +
                          " --assigner exact-fast --grid frustum --tiles 96 --slices 8 --dump-frames 2 --write-dump ";
  const Outcome written = tool(run + dumps + " --set 'storages=[{\"name\":\"fixed\",\"cap\":2}]'");
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_NE(written.err.find(" lists are cut off where the storage has no room, by "), std::string::npos)
      << written.err;
  const Outcome lost = tool("check --methods none " + dumps);
  EXPECT_EQ(lost.code, 1);
  EXPECT_NE(lost.out.find(" lost in cells whose list is full (lists[].per_cell)"), std::string::npos) << lost.out;
  const Outcome whole = tool(run + (folder / "whole").string() + " --set 'storages=[\"fixed\"]'");
  EXPECT_EQ(whole.err.find("cut off"), std::string::npos) << whole.err;
}

TEST(Check, says_the_same_on_any_number_of_threads) {
  const Folder folder;
  const std::string dumps = (folder / "dumps").string();
  ASSERT_EQ(tool("run -q " + source_file("scenes/street.glb") +
                 " --assigner exact-fast --grid frustum --tiles 96 --slices 8 --dump-frames 2 --write-dump " + dumps +
                 " --set 'storages=[{\"name\":\"fixed\",\"cap\":2}]'")
                .code,
            0);
  const auto checked = [&](const std::string& threads) {
    const std::string json = (folder / "check.json").string();
    const Outcome done = tool("check --methods all " + threads + " --json " + json + " " + dumps);
    EXPECT_EQ(done.code, 1) << done.err;
    return done.out + done.err + file_text(json);
  };
  const std::string once = checked("--threads 1");
  for (const std::string threads : {"", "--threads 2", "--threads 5"}) EXPECT_EQ(checked(threads), once) << threads;
}

TEST(Check, names_of_a_dump_reach_no_terminal_as_they_are) {
  Small small;
  small.dump["name"] = "frame\n  lists: right: no light is lost\n\x1b]0;title\x07";
  small.dump["engine"] = "\x1b[31mred";
  small.dump["lists"][0]["set"] = "a\nb";
  small.write<std::uint16_t>("indices.bin", {0, 7});
  for (const std::string& text : {small.check().out, small.check("--json -").out, small.check("--json -").err}) {
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
    EXPECT_EQ(text.find("frame\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("a\nb"), std::string::npos) << text;
  }
  small.dump["lists"][0]["rows"]["buffer"] = "x\ny\x1b[2J";
  const Outcome refused = small.check();
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  EXPECT_EQ(refused.err.find('\x1b'), std::string::npos);
}

TEST(Check, a_member_that_stands_twice_in_a_dump_is_refused) {
  Small small;
  std::string text = file_text(small.path());
  text.replace(text.find("\"count\":1,"), 10, "\"count\":1,\"count\":1,");
  const Outcome refused = tool("check " + small.folder.write("dump.json", text).string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is the key \"count\" for the second time in its object"), std::string::npos)
      << refused.err;
}

TEST(Check, the_smallest_dump_of_the_document_is_one) {
  const std::string text = file_text(source_file("docs/check.md"));
  const std::size_t begin = text.find("```json\n") + 8, end = text.find("```", begin);
  const Small small;
  const std::string path = small.folder.write("smallest.json", text.substr(begin, end - begin)).string();
  EXPECT_EQ(tool("validate " + path).out, path + ": valid, a dump for `clusterbench check` with 1 list\n");
  small.folder.write("lights.bin", std::string(4800, '\0'));
  small.folder.write("cells.bin", std::string(27648, '\0'));
  const Outcome done = tool("check --methods none " + path);
  EXPECT_EQ(done.code, 1) << done.err;
  EXPECT_NE(done.out.find("no light reaches a cell, so nothing was checked"), std::string::npos) << done.out;
}

TEST(Check, a_template_is_printed_and_another_engine_gets_a_list_of_those_that_are_there) {
  const Outcome printed = tool("check --template filament");
  EXPECT_EQ(printed.code, 0);
  EXPECT_NE(printed.out.find("\"dump_version\": 1"), std::string::npos);
  const Outcome unknown = tool("check --template filamnt");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'filament'?"), std::string::npos) << unknown.err;
  for (const char* flag : {"--json", "--page", "--most-lost", "--threads", "--methods"}) {
    const bool is_file = flag == std::string("--json") || flag == std::string("--page");
    const Folder folder;
    const std::string value = is_file ? (folder / "out").string() : flag == std::string("--methods") ? "all" : "2";
    const Outcome refused = tool("check --template bevy " + std::string(flag) + " " + value);
    EXPECT_EQ(refused.code, 2) << flag;
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(refused.err, "clusterbench: " + std::string(flag) +
                               ": has no meaning with --template, which checks nothing; allowed: --template alone\n");
  }
}

}  // namespace
}  // namespace clusterbench::test
