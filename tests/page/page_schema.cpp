// Prints the JSON Schema of a page's data, of a report or (page_schema check) of `clusterbench check`, for
// page/types.mjs.

#include <iostream>
#include <string_view>

#include "result/documents/check_page.h"
#include "result/documents/page.h"

int main(int argc, char** argv) {
  namespace result = clusterbench::result;
  const bool is_of_check = argc > 1 && std::string_view(argv[1]) == "check";
  std::cout << (is_of_check ? result::check_page_schema() : result::page_schema()).dump(2) << "\n";
}
