// Standard output that takes nothing, standard streams that are closed, and inputs that come through pipes.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

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
           "timing": {"sweep_mib": 4, "rounds": 6, "launches": 1, "min_time_ms": 0.1, "frames": 2}})")
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

// Some commands read an input twice: first to see what it is.
TEST(Streams, an_input_may_come_through_a_pipe) {
  const StreamPlace place;
  for (const auto& [command, input] : {std::pair<std::string, std::string>("validate", place.config),
                                       {"validate", place.result},
                                       {"run -q --no-timing", place.config},
                                       {"size -q", place.config},
                                       {"size", place.result},
                                       {"recommend -q --no-timing", place.config},
                                       {"worst-case -q --random 0 --evaluations 20", place.config},
                                       {"ratio", place.result},
                                       {"merge", place.result},
                                       {"export --format csv", place.result}}) {
    const std::string out = (place.folder / "out").string(), err = (place.folder / "err").string();
    const std::string script = program() + " " + command + " <(cat " + input + ") >" + out + " 2>" + err;
    const int status = std::system(("timeout 60 bash -c \"" + script + "\"").c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), tool(command + " " + input).code) << command << ": " << file_text(err);
    EXPECT_NE(file_text(out), "") << command;
  }
}

TEST(Streams, output_that_cannot_be_written_is_an_error_of_every_command) {
  const StreamPlace place;
  const auto tells = [&](const char* reason) {
    return file_text(place.folder / "err").find(reason) != std::string::npos;
  };
  for (const std::string& arguments :
       {std::string("--version"), std::string("--help"), std::string("list"), std::string("man"),
        std::string("completion bash"), std::string("schema result"), "run --dry-run " + place.config,
        "run -q --no-timing " + place.config, "validate " + place.result, "size " + place.result,
        "ratio " + place.result, "ratio --csv - " + place.result, "compare " + place.result + " " + place.result,
        "export --format csv " + place.result, "merge " + place.result, "report " + place.result,
        "history show --all " + place.history, "scene info " + source_file("scenes/street.glb"),
        std::string("stress -q --cases H1 --methods aabb --tries 0")}) {
    EXPECT_EQ(place.code(arguments, ">/dev/null"), 0) << arguments << file_text(place.folder / "err");
    EXPECT_EQ(place.code(arguments, ">/dev/full"), 70) << arguments;
    EXPECT_TRUE(tells("No space left on device")) << arguments << ": " << file_text(place.folder / "err");
    EXPECT_EQ(place.code(arguments, ">&-"), 70) << arguments;
    EXPECT_TRUE(tells("is closed") || tells("Bad file descriptor"))
        << arguments << ": " << file_text(place.folder / "err");
  }
}

// Another program that has the same pipe open can set it to O_NONBLOCK.
TEST(Streams, a_pipe_that_does_not_block_gets_all_of_the_output) {
  constexpr int k_to = 9;  // a shell may take numbers of one digit alone
  const StreamPlace place;
  for (const std::string& arguments : {std::string("schema result"), std::string("man"),
                                       "run -q --no-timing " + place.config, "report " + place.result}) {
    const std::string whole = tool(arguments).out;
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    ASSERT_EQ(dup2(ends[1], k_to), k_to);
    close(ends[1]);
    ASSERT_EQ(fcntl(k_to, F_SETFL, O_NONBLOCK), 0);
    ASSERT_GT(fcntl(k_to, F_SETPIPE_SZ, 4096), 0);
    std::string taken;
    std::thread reader([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      char some[4096];
      for (ssize_t got = 0; (got = read(ends[0], some, sizeof some)) > 0;)
        taken.append(some, static_cast<std::size_t>(got));
    });
    EXPECT_EQ(place.code(arguments, ">&" + std::to_string(k_to)), 0)
        << arguments << ": " << file_text(place.folder / "err");
    close(k_to);
    reader.join();
    close(ends[0]);
    EXPECT_EQ(taken.size(), whole.size()) << arguments;
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
