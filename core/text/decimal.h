#pragma once

namespace umbsim {

/// Room for the longest number that write_decimal() writes.
constexpr int kDecimalRoom = 32;

/// `value` to the nearest 1e-9 as the shortest decimal that reads back the same, as fmt writes it, and several times
/// faster where the number is an ordinary one. Returns the end. Needs kDecimalRoom characters.
char* write_decimal(char* text, double value);

}  // namespace umbsim
