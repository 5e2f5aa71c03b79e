// The index of a folder of pictures, as `report` reads it.

#include "fuzz/input.h"
#include "report/page/page_pictures.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  return fuzz::answered([&] {
    const std::filesystem::path file = fuzz::written(data, size, ".json"), folder = file.parent_path();
    std::filesystem::rename(file, folder / "pictures.json");
    static_cast<void>(report::page_pictures(folder, {}));
  });
}
