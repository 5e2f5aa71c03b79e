#pragma once
// Tiles that grow where a buffer is too small for the tiles that were asked for, as engines have them.

#include <cstdint>
#include <string>

#include "grid/tiling.h"
#include "view/frame.h"

namespace clusterbench::grid {

struct Reaction {
  // entries: of a method's lists in the frame before; columns and rows shrink by the square root of what is too much
  // (Bevy, bevy_light's assign.rs, early 2026). mask_words: words of a bit per light in each tile, in the frame itself;
  // tiles double until there is room for them (Unity URP, Forward+).
  enum class To : std::uint8_t { entries, mask_words };
  To to = To::entries;
  std::uint64_t most = 16384;     // entries, or words of 32 bits, that there is room for
  std::string of;                 // entries: whose lists
  std::uint64_t most_lights = 0;  // mask_words: further lights in view get no bit; 0: all do

  friend bool operator==(const Reaction&, const Reaction&) = default;
};

// "entries", "mask-words"
const char* name_of(Reaction::To to);

// Tiles of the frame after one whose lists took so many entries: columns and rows of `asked` times sqrt(most / entries)
// in single precision, rounded down, at least one of each; `asked` itself where there was room. It says nothing of the
// tiles that the entries were counted in: so engines do it, and a scene that is just as full in the next frame has
// alternately small and large tiles. Tiles in pixels stay so: whole ones, rounded up.
Tiling shrunk_tiles(const Tiling& asked, Vec2i viewport, std::uint64_t entries, std::uint64_t most);

// Words of all tiles together, with a bit per light.
std::uint64_t mask_words(const Tiling& tiles, Vec2i viewport, std::uint64_t lights);
// Of tiles in pixels: both edges doubled until the words fit. One tile that holds the whole picture is not doubled
// again, whatever its words.
Tiling doubled_tiles(const Tiling& asked, Vec2i viewport, std::uint64_t lights, std::uint64_t most);

// Lights in view (lights_in_view.h).
std::uint64_t count_lights_in_view(const view::Frame& frame);

// Lights that get a bit.
std::uint64_t lights_with_bits(const Reaction& reaction, const view::Frame& frame);

}  // namespace clusterbench::grid
