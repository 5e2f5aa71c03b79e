#pragma once
// Pictures that `clusterbench run --images` has made, for the page.

#include <filesystem>
#include <vector>

#include "report/page/page.h"

namespace clusterbench::report {

// Those of the folder's index (pictures.json) that show cases of these results. Throws Error where there is no index,
// or a picture of it cannot be read, or all together are too large for a page.
std::vector<PagePicture> page_pictures(const std::filesystem::path& folder, const std::vector<NamedResult>& results);

}  // namespace clusterbench::report
