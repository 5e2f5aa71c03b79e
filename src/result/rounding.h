#pragma once
// The number of digits that a record keeps.

namespace clusterbench::result {

// For counts: nine digits of a fraction, since the counts are recorded, too; whole numbers are exact.
double counted(double value);
// For measurements: six digits, far more than the precision of any clock.
double measured(double value);

}  // namespace clusterbench::result
