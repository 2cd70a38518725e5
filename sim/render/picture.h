#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/render/image.h"

namespace assay::render {

std::string EncodedPng(const Image& image);  // the contents of a PNG file
// Throws EnvironmentError if the file cannot be written completely.
void WritePng(const Image& image, const std::filesystem::path& file);
// Throws InputError if the file is not a readable picture.
Image ReadImage(const std::filesystem::path& file);

// The image with the labels, each joined to its point, no two of them on each other.
Image WithLabels(const Image& image, const std::vector<Label>& labels);

// The images, all of one size, in rows of `columns`, each with its caption below, on white; the
// legend's entries below all, a row for each. Images are made smaller where a row of them would be
// wider than 2400 pixels.
Image ContactSheet(const std::vector<CaptionedImage>& images, int columns,
                   const std::vector<LegendEntry>& legend = {});

// The picture of a drawing that is `samples` times too wide and too high, and whose rows, as
// OpenGL's, begin at the bottom. OSMesa has no other antialiasing that is the same on every
// machine.
Image FromSamples(const Image& drawing, int samples);

}  // namespace assay::render
