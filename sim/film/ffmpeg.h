#pragma once

#include <filesystem>
#include <memory>

#include "sim/film/moving_picture.h"

namespace assay::film {

// Returns the path of the program ffmpeg, found in the folders of PATH; empty if there is none.
std::filesystem::path FindFfmpeg();

// Begins a film in the format MP4, which the program ffmpeg encodes. ffmpeg is started as a program
// of its own and is no part of this one. Every picture lasts equally long, so the last one is
// repeated for its duration. Throws EnvironmentError, which names the Debian package, if there is
// no ffmpeg.
std::unique_ptr<MovingPicture> BeginMp4(const Format& format);

}  // namespace assay::film
