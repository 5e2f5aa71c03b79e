#pragma once
// Where the checkout is and what it built. tests/CMakeLists.txt writes these functions into a file of their own, so
// that the objects of the tests name no folder and are the same in every checkout: ccache serves all of them.

#include <string>

namespace clusterbench::test {

std::string source_dir();      // the root of the checkout
std::string program();         // clusterbench
std::string slowed_program();  // clusterbench_slowed, whose assignment takes longer
std::string plugin_folder();   // the plug-ins of tests/plugin

}  // namespace clusterbench::test
