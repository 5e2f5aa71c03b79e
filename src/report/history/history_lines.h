#pragma once
// The lines of a history's file: JSON, one result each.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/history/history.h"

namespace clusterbench::report {

// Without its end.
std::string written_line(const result::Result& result, const std::string& commit);

// Points into the file's text.
struct HistoryLine {
  std::string_view text;
  std::size_t number;  // in the file, from 1
  std::size_t end;     // the position after it in the file

  // Both throw Error, with file and line, for what is no line of a history.
  HistoryEntry whole(const std::string& path) const;
  // Without the cases, which are most of a line: each result that is added reads all lines before it. They are skipped
  // unseen where the line is as `written_line` writes it, and left in where it is not.
  HistoryEntry head(const std::string& path) const;
};

// Those that are not blank. Throws Error for an unfinished last line.
std::vector<HistoryLine> history_lines(const std::string& path, std::string_view text);

}  // namespace clusterbench::report
