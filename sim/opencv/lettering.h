#pragma once

#include <string>

namespace cv {
class Mat;
}

namespace assay::opencv {

// Dark letters for lines of text of one height.
class Lettering {
 public:
  // `height` of a line, pixels.
  explicit Lettering(int height);

  // Returns the text, or as much of its start as fits into the width (pixels), with an ellipsis.
  std::string Fitted(const std::string& text, int width) const;
  int Width(const std::string& text) const;  // pixels
  // Draws the text. Its baseline begins at x and y, pixels from the left and from the top.
  void Write(const std::string& text, int x, int y, cv::Mat& picture) const;
  int thickness() const { return thickness_; }  // of the strokes, pixels

 private:
  double scale_;
  int thickness_;
};

}  // namespace assay::opencv
