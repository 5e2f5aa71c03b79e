// Prints the JSON Schema of a page's data, for page/types.mjs.

#include <iostream>

#include "result/documents/page.h"

int main() {
  std::cout << clusterbench::result::page_schema().dump(2) << "\n";
}
