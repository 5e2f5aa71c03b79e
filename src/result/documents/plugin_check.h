#pragma once
// What `clusterbench plugin check` found: the output of --json.

#include "result/result.h"

namespace clusterbench::result {

struct PluginTest {
  static About about() { return About("One test of one method"); }
  RECORD(PluginTest);
  FIELD(std::string, method, "As configurations name it");
  FIELD(std::string, test, "Its name, for --test");
  FIELD(std::string, verdict,
        About("crashed: a signal ended its process, or the plug-in did, or it took too much memory. timed_out: it was "
              "not done in time. skipped: "
              "it does "
              "not apply")
            .one_of({"passed", "failed", "crashed", "timed_out", "skipped"}));
  FIELD(std::vector<std::string>, reasons, "Why it did not pass, a sentence each; the first five");
  FIELD(std::string, looked_at, "How much was looked at, as text; empty if it did not end");
  END_RECORD;
};

struct PluginCheck {
  RECORD(PluginCheck);
  FIELD(int, plugin_check_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(Plugin, plugin, "Which was checked");
  FIELD(std::uint64_t, seed, "Of all that is drawn");
  FIELD(double, seconds,
        About("For each of the tests that draw until time is over", "s").finite().at_least(0).as_fraction());
  FIELD(std::vector<PluginTest>, tests, "Method by method, in the order in which they were run");
  FIELD(std::string, verdict,
        About("passed: no test failed. incomplete: interrupted before all tests were run")
            .one_of({"passed", "failed", "incomplete"}));
  END_RECORD;
};

Json plugin_check_schema();

extern template const Type& type_of<PluginCheck>();

}  // namespace clusterbench::result
