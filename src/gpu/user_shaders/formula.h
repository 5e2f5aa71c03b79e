#pragma once
// Formulas of a shader's JSON: "ceil(cells / 64)", "cells * (4 + 4 * cap)". Numbers, names, + - * / %, parentheses, and
// min(a, b), max(a, b), ceil(a), floor(a). In double precision, so that whole numbers below 2^53 are exact; / is not
// rounded.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "result/fields.h"

namespace clusterbench::gpu {

// The value of a name; null where there is none.
using NumberOf = std::function<const double*(const std::string& name)>;

// Throws Error ("", `where`) for a formula that cannot be read, with the column, and for one of which a name is not in
// `names`.
void check_formula(const std::string& formula, const std::vector<std::string>& names, const std::string& where);

// The value of a formula that check_formula() has read. Throws Error ("", `where`) for a value that is not finite.
double number_of_formula(const std::string& formula, const NumberOf& number, const std::string& where);

// A whole number from 0 to 2^53 as JSON has it: a number, or a formula. Throws Error ("", `where`) for any other value.
std::uint64_t amount_of(const result::Json& given, const NumberOf& number, const std::string& where);
// Throws Error as both; a value that names change is not judged.
void check_amount(const result::Json& given, const std::vector<std::string>& names, const std::string& where);

}  // namespace clusterbench::gpu
