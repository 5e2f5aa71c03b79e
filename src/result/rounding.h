#pragma once
// How many digits of a number a record keeps.

namespace clusterbench::result {

// Of what is counted: nine digits of a fraction, since the counts stand beside it; whole numbers are exact.
double counted(double value);
// Of what is measured: six digits, far more than any clock gives.
double measured(double value);

}  // namespace clusterbench::result
