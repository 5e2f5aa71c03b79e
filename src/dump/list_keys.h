#pragma once
// Keys of a dump's lists that have no meaning beside their layout: what they say would be passed over in silence.

#include <string>

#include "result/documents/dump.h"

namespace clusterbench::dump {

// `pointer`: of these lists, "/lists/2". Throws Error ("", JSON pointer).
void check_list_keys(const result::DumpLists& lists, const std::string& pointer);

}  // namespace clusterbench::dump
