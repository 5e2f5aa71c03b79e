#pragma once
// Results as a page: one HTML file that works offline and loads no other file.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "result/documents/check_page.h"
#include "result/documents/page.h"

namespace clusterbench::report {

struct NamedResult {
  std::string file;  // the name shown to the reader of the page
  result::Result result;
};

using result::PagePicture;

// The page of `clusterbench check`. Throws Error if this build has no page.
std::string check_page(const result::CheckPage& data);

// Throws Error if this build has no page. `command`: the command that makes the page again, shown on it.
std::string page(const std::vector<NamedResult>& results, const std::string& command,
                 const std::vector<PagePicture>& pictures = {});

// A template with its data. Throws Error for that command if this build has no pages.
std::string filled_page(std::string_view page_template, const nlohmann::ordered_json& data, const char* command);

// JSON for a <script> element: no string in it can end the element or a line.
std::string script_json(const nlohmann::ordered_json& value);

}  // namespace clusterbench::report
