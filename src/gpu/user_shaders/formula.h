#pragma once
// Formulas of a shader's JSON: "ceil(cells / 64)", "cells * (4 + 4 * cap)". Numbers, names, + - * / %, parentheses, and
// min(a, b), max(a, b), ceil(a), floor(a). In double precision, so that whole numbers below 2^53 are exact; / is not
// rounded.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "result/fields.h"

namespace clusterbench::gpu {

// The value of a name; null where there is none.
using NumberOf = std::function<const double*(const std::string& name)>;

// Throws Error ("", `where`) for a formula that cannot be read, with the column, for one of which a name is not in
// `names`, and for one that cannot be right whatever its names stand for: a division by 0, a constant that is not
// finite.
void check_formula(const std::string& formula, const std::vector<std::string>& names, const std::string& where);

// The value of a formula that check_formula() has read. Throws Error ("", `where`) for a value that is not finite.
double number_of_formula(const std::string& formula, const NumberOf& number, const std::string& where);
// The same where the formula names nothing.
std::optional<double> constant_of_formula(const std::string& formula);

// A whole number from 0 to 2^53 as JSON has it: a number, or a formula. Throws Error ("", `where`) for any other value.
std::uint64_t amount_of(const result::Json& given, const NumberOf& number, const std::string& where);
// Throws Error as both; a value that names change is not judged. `least`: of a constant.
void check_amount(const result::Json& given, const std::vector<std::string>& names, const std::string& where,
                  std::uint64_t least = 0);
// Of an amount that check_amount() has read: nullopt where names change it.
std::optional<std::uint64_t> constant_amount(const result::Json& given);

// What a message shows of a text of a file: its beginning.
std::string shortened(const std::string& text);

}  // namespace clusterbench::gpu
