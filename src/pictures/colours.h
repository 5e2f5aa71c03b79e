#pragma once
// The colours of pictures. Those of counts are the colours of cells in the page of `clusterbench report`.

#include <span>
#include <vector>

#include "pictures/canvas.h"

namespace clusterbench::pictures {

// The first colours of every palette.
enum Basic : Colour { k_paper, k_ink, k_faint, k_no_surface, k_no_answer_dark, k_no_answer_light, k_empty, k_basics };
std::vector<Rgb> basic_palette();

// A colour at `share` (0 to 1) of a scale.
Rgb lights_colour(double share);           // viridis
Rgb false_positives_colour(double share);  // ambers
Rgb missed_colour(double share);           // magentas

// A colour in the light that a surface reflects, 0 to 1.
Rgb shaded(const Rgb& colour, double light);
inline constexpr Rgb k_stone{150, 152, 158};  // surfaces without data

// This many colours, with clearly different neighbours.
std::vector<Rgb> distinct_colours(int count);

}  // namespace clusterbench::pictures
