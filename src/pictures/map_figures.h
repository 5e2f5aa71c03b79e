#pragma once
// One figure per kind of picture.

#include <array>
#include <optional>
#include <string>

#include "pictures/figure.h"
#include "pictures/pixel_maps.h"

namespace clusterbench::pictures {

enum class Kind : std::uint8_t {
  lights,           // lights that each pixel evaluates
  levels,           // the same in four steps: none, 1 to 3, 4 and 5, more
  types,            // red: points, green: spots
  false_positives,  // lights that it evaluates and that do not reach it
  missed,           // lights that reach it and that it does not evaluate
  lists,            // pixels with the same list have the same colour
  depth,            // of the surfaces
  strip             // lights in frames along the path
};
struct KindName {
  Kind kind;
  const char* name;
  const char* summary;
};
inline constexpr std::array k_kind_names = {
    KindName{Kind::lights, "lights", "lights that each pixel evaluates"},
    KindName{Kind::levels, "levels", "the same in steps: blue from 1, green from 4, red from 6"},
    KindName{Kind::types, "types", "points red, spots green"},
    KindName{Kind::false_positives, "false-positives", "lights that a pixel evaluates and that do not reach it"},
    KindName{Kind::missed, "missed", "lights that reach a pixel and that it does not evaluate"},
    KindName{Kind::lists, "lists", "a colour per list"},
    KindName{Kind::depth, "depth", "how far away the surfaces are"},
    KindName{Kind::strip, "strip", "lights in up to eight frames along the path"}};
const char* name_of(Kind kind);

// The text above a map.
struct Heading {
  std::string method;  // with its storage, in the title
  std::string scene_line, grid_line;
};

// The common data of a frame's maps.
struct Seen {
  const Surface& surface;
  const std::vector<float>& relief;
  std::uint64_t needed = 0;  // lights that reach the pixels' surfaces
};

Figure lights_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps, std::uint32_t top);
Figure levels_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps);
Figure types_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps);
Figure false_positives_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps, std::uint32_t top);
Figure missed_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps);
Figure lists_figure(const Heading& heading, const Seen& seen, const PixelMaps& maps, const ListMap& lists);
Figure depth_figure(const Heading& heading, const Seen& seen);

// A frame of a strip.
struct StripFrame {
  int frame = 0;
  Vec2i size{0, 0};
  std::vector<PixelMaps::State> state;
  std::vector<std::uint32_t> lights;
  MapTotals total;
  std::uint64_t surfaces = 0;
};
Figure strip_figure(const Heading& heading, const std::vector<StripFrame>& frames, std::uint32_t top);

}  // namespace clusterbench::pictures
