// The example, but that it changes the locale as it is loaded.

#include <clocale>

#include "../examples/cell_boxes.cpp"

namespace {
[[maybe_unused]] const char* const locale = std::setlocale(LC_ALL, "C.UTF-8");
}
