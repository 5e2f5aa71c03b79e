#pragma once
// Tiles that grow if a buffer is too small for the requested tiles, as in engines.

#include <cstdint>
#include <string>

#include "grid/tiling.h"
#include "view/frame.h"

namespace clusterbench::grid {

struct Reaction {
  // entries: of a method's lists in the previous frame; the numbers of columns and rows shrink by the square root of
  // the excess factor (Bevy, bevy_light's assign.rs, early 2026). mask_words: words of a bit per light in each tile, in
  // the same frame; tiles double until the words fit (Unity URP, Forward+).
  enum class To : std::uint8_t { entries, mask_words };
  To to = To::entries;
  std::uint64_t most = 16384;     // available room in entries, or in words of 32 bits
  std::string of;                 // entries: method of the counted lists
  std::uint64_t most_lights = 0;  // mask_words: further lights in view get no bit; 0: all do

  friend bool operator==(const Reaction&, const Reaction&) = default;
};

// "entries", "mask-words"
const char* name_of(Reaction::To to);

// Tiles of the frame after one whose lists had this many entries: columns and rows of the requested tiles times
// sqrt(most / entries) in single precision, rounded down, at least one of each; the requested tiles themselves if there
// was room. The formula ignores the tiles in which the entries were counted, as in engines: in a scene that stays too
// full, small and large tiles alternate. Tiles in pixels stay so: whole pixels, rounded up.
Tiling shrunk_tiles(const Tiling& requested, Vec2i viewport, std::uint64_t entries, std::uint64_t most);

// Words of all tiles together, with a bit per light.
std::uint64_t mask_words(const Tiling& tiles, Vec2i viewport, std::uint64_t lights);
// For tiles in pixels: both edges are doubled until the words fit. A single tile that covers the whole picture is not
// doubled again, even if its words do not fit.
Tiling doubled_tiles(const Tiling& requested, Vec2i viewport, std::uint64_t lights, std::uint64_t most);

// Lights in view (lights_in_view.h).
std::uint64_t count_lights_in_view(const view::Frame& frame);

// Lights that get a bit.
std::uint64_t lights_with_bits(const Reaction& reaction, const view::Frame& frame);

}  // namespace clusterbench::grid
