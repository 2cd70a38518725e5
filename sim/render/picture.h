#pragma once

#include <string>
#include <vector>

#include "sim/render/image.h"

namespace assay::render {

// Operations on finished pictures. The module sim/opencv does the work on the pixels
// (picture_library.h).

// Returns the contents of a PNG file with the rendered image.
std::string EncodedPng(const Image& image);

// Returns the image with the labels. Each label is joined to its point, and no two overlap.
Image WithLabels(const Image& image, const std::vector<Label>& labels);

// Returns one image with all images, which must have the same size. The images stand in rows of
// `columns` on white, each with its caption below it. The entries of the legend follow below, one
// per row. Images are made smaller if a row of them would be wider than 2400 pixels.
Image ContactSheet(const std::vector<CaptionedImage>& images, int columns,
                   const std::vector<LegendEntry>& legend = {});

// Returns the image with the caption below it, which makes it higher.
Image WithCaption(const Image& image, const Caption& caption);

// Returns the picture of a drawing that is `samples` times too wide and too high. The rows of the
// drawing begin at the bottom, as in OpenGL. OSMesa has no other antialiasing that gives the same
// result on every machine.
Image FromSamples(const Image& drawing, int samples);

}  // namespace assay::render
