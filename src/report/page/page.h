#pragma once
// Results as a page: one HTML file that works from disk and asks for nothing else.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

struct NamedResult {
  std::string file;  // as the reader of the page should know it
  result::Result result;
};

// A picture of cases, as a part of the page.
struct PagePicture {
  std::string kind;
  std::optional<int> frame;
  std::vector<std::string> case_ids;
  std::string text;  // for those who do not see it
  std::string url;   // with the picture in it
};

// Throws Error if this build has no page. `command`: the one that makes the page again, shown on it.
std::string page(const std::vector<NamedResult>& results, const std::string& command,
                 const std::vector<PagePicture>& pictures = {});

// A template with its data. Throws Error for that command if this build has no pages.
std::string filled_page(std::string_view page_template, const nlohmann::ordered_json& data, const char* command);

// JSON as it can stand in a <script> element: whatever is in its strings, it ends neither the element nor a line.
std::string script_json(const nlohmann::ordered_json& value);

}  // namespace clusterbench::report
