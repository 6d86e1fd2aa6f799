#pragma once

namespace umbsim {

/// Whether progress is shown: standard error is a terminal, and nobody asked for silence.
bool shows_progress();

/// From now on no progress is shown.
void hide_progress();

/// Whether what goes to standard output (1) or standard error (2) may be coloured: it is a terminal that knows how, and
/// NO_COLOR is not set (https://no-color.org).
bool shows_colour(int file_descriptor);

}  // namespace umbsim
