// Standard output that takes nothing, and standard streams that are closed.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

struct StreamPlace {
  Folder folder;
  std::string config = folder
                           .write("c.json", R"({"scenes": [{"path": ")" + source_file("scenes/street.glb") +
                                                R"(", "frames": 2}], "grids": [{"kind": "world", "cells": [16, 4, 16]}],
           "assigners": ["world-grid", "world-grid-fast"],
           "timing": {"rounds": 6, "launches": 1, "min_time_ms": 0.1, "frames": 2}})")
                           .string();
  std::string result = (folder / "r.json").string(), history = (folder / "h.jsonl").string();

  StreamPlace() {
    EXPECT_EQ(tool("run -q " + config + " -o " + result).code, 0);
    EXPECT_EQ(tool("history add " + result + " " + history).code, 0);
  }

  // With redirections of its own.
  int code(const std::string& arguments, const std::string& redirections) const {
    const int status = std::system(
        (test::program() + " " + arguments + " 2>" + (folder / "err").string() + " </dev/null " + redirections)
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }
};

TEST(Streams, output_that_cannot_be_written_is_an_error_of_every_command) {
  const StreamPlace place;
  for (const std::string& arguments :
       {std::string("--version"), std::string("--help"), std::string("list"), std::string("man"),
        std::string("completion bash"), std::string("schema result"), "run --dry-run " + place.config,
        "run -q --no-timing " + place.config, "validate " + place.result, "size " + place.result,
        "ratio " + place.result, "ratio --csv - " + place.result, "compare " + place.result + " " + place.result,
        "export --format csv " + place.result, "merge " + place.result, "report " + place.result,
        "history show --all " + place.history, "scene info " + source_file("scenes/street.glb"),
        std::string("stress -q --cases H1 --methods aabb --tries 0")}) {
    EXPECT_EQ(place.code(arguments, ">/dev/null"), 0) << arguments << file_text(place.folder / "err");
    const int full = place.code(arguments, ">/dev/full");
    EXPECT_TRUE(full == 70 || full == 2) << arguments << ": " << full;
    EXPECT_NE(file_text(place.folder / "err"), "") << arguments;
  }
}

TEST(Streams, closed_ones_do_not_get_into_files) {
  const StreamPlace place;
  EXPECT_EQ(place.code("run -q " + place.config + " -o " + place.result, ">&- <&- 2>&-"), 0);
  EXPECT_EQ(tool("validate " + place.result).code, 0);
  EXPECT_EQ(place.code("list", ">&-"), 70);
}

}  // namespace
}  // namespace clusterbench::test
