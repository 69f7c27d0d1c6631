// Who goes first when there are more threads than cores: the window, then the picture and previews,
// then what takes long.
#pragma once

namespace knotlight {

// Nice values (Linux keeps one per thread, and hands it on to threads that a thread starts).
inline constexpr int niceness_of_picture = 4;
inline constexpr int niceness_of_full_solve = 12;

// Of the calling thread, which cannot go back. If it fails, the thread is only less polite.
void set_niceness(int niceness);

}  // namespace knotlight
