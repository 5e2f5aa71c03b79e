#pragma once
// A case without figures: its method crashed, did not return, took too much memory, or failed.

#include "result/fields.h"

namespace clusterbench::result {

struct BrokenCase {
  RECORD(BrokenCase);
  FIELD(std::string, id, "As of a case");
  FIELD(std::string, settings, "As of a case");
  FIELD(std::string, name, "As of a case");
  FIELD(std::string, scene, "Name of one of scenes");
  FIELD(std::string, camera, "As of a case");
  FIELD(std::optional<std::string>, preset, "As of a case; absent for the configuration's own clusterings");
  FIELD(std::string, method, "Name of the assigner");
  FIELD(std::optional<std::string>, plugin, "The plug-in that the method is of; absent for one of --shader");
  FIELD(std::string, kind,
        About("crashed: its process ended, by a signal or since the plug-in ended it. timed_out: a call did not return "
              "within --plugin-timeout. out_of_memory: the process took more than --plugin-memory. failed: the plug-in "
              "said so, or what it or a shader left cannot be light lists")
            .one_of({"crashed", "timed_out", "out_of_memory", "failed"}));
  FIELD(std::string, reason, "The same for people, without the case's name");
  FIELD(std::string, step,
        About("The call in which, or after which, it happened. unload: as the process ended")
            .one_of({"load", "create", "build", "assign", "query", "destroy", "unload"}));
  FIELD(std::optional<std::uint64_t>, frame, "Of the camera's path; absent where the call is of none", "index",
        "the path");
  FIELD(std::optional<std::string>, pass, "The work that the call was part of, as text; absent where it is unknown");
  FIELD(std::optional<std::string>, signal, "That ended the process, as SIGSEGV; absent where none did");
  END_RECORD;
};

}  // namespace clusterbench::result
