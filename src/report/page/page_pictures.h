#pragma once
// Pictures made by `clusterbench run --images`, for the page.

#include <filesystem>
#include <vector>

#include "report/page/page.h"

namespace clusterbench::report {

// The pictures of the folder's index (pictures.json) that show cases of these results. Throws Error if there is no
// index, if a picture cannot be read, or if all together are too large for a page.
std::vector<PagePicture> page_pictures(const std::filesystem::path& folder, const std::vector<NamedResult>& results);

}  // namespace clusterbench::report
