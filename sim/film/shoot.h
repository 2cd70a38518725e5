#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "sim/film/film.h"
#include "sim/film/moving_picture.h"

namespace assay::film {

// Returns whether the file's name ends with .webp or .mp4.
bool IsMovingPicture(const std::filesystem::path& file);

// Begins the file. Throws EnvironmentError if it cannot be made on this machine. The functions of
// the object throw EnvironmentError if the file cannot be written.
std::unique_ptr<MovingPicture> Begin(const Format& format);

// Draws the film's pictures one after the other and appends each. The next picture is drawn while
// the last one is encoded by another thread. Calls `after` with the number of pictures drawn, and
// ends early if it returns false. Returns the number of pictures in the file.
int Shoot(Film& film, MovingPicture& file, const std::function<bool(int)>& after);

}  // namespace assay::film
