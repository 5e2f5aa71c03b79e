#pragma once
// Lists of a dump against the exact ones.

#include "dump/dump_frame.h"
#include "dump/our_methods.h"
#include "dump/page_frame.h"
#include "result/documents/check.h"

namespace clusterbench::dump {

struct JudgeOptions {
  MethodChoice methods{};
  int threads = 1;
  result::CheckPageFrame* page = nullptr;  // filled where it is asked for
  std::size_t* page_room = nullptr;        // with it: see page_set()
};

// Reads the lists, compares them with the truth, and tries other descriptions where lights are lost or most listed
// pairs are for nothing. Throws Error (file, JSON pointer or byte) for a dump that describes no frame.
result::CheckedDump judge(const DumpFile& dump, const JudgeOptions& options);

// The worst verdict of all sets. Where no light reaches a cell and none is listed a set does not count, unless all are
// such sets.
std::string worst_verdict(const std::vector<result::CheckedDump>& frames);

// For people. `most`: how many lost lights are named.
std::string check_text(const result::CheckedDump& checked, std::size_t most);

}  // namespace clusterbench::dump
