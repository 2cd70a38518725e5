#include "sim/film/webp.h"

#include <cmath>
#include <fstream>

#include "planner/base/input_files/input_error.h"
#include "planner/base/module.h"
#include "sim/film/webp_library.h"

namespace assay::film {
namespace {

const WebpLibrary& Webp() {
  static const WebpLibrary& library =
      assay::Open<WebpLibrary>({.file = "libassay_webp.so",
                                .entry = "AssayWebpLibrary",
                                .needed_for = "films",
                                .debian_packages = "libwebp7 libwebpmux3"});
  return library;
}

class WebpPicture : public MovingPicture {
 public:
  explicit WebpPicture(const Format& format)
      : file_(format.file), encoder_(Webp().Begin(format.width, format.height)) {
    if (!encoder_) Fail("libwebp has no room for pictures of this size");
  }

  void Add(const render::Image& image, double duration) override {
    if (!encoder_->Add(image, Milliseconds())) Fail("libwebp cannot encode a picture");
    time_ += duration;
  }

  void Finish() override {
    const std::vector<std::uint8_t> bytes = encoder_->Finish(Milliseconds());
    if (bytes.empty()) Fail("libwebp cannot put the pictures together");
    std::ofstream stream(file_, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) Fail("cannot be written");
  }

 private:
  int Milliseconds() const { return static_cast<int>(std::lround(1000 * time_)); }
  [[noreturn]] void Fail(const char* what) const {
    throw EnvironmentError(file_.string() + ": " + what);
  }

  std::filesystem::path file_;
  std::unique_ptr<WebpEncoder> encoder_;
  double time_ = 0;  // seconds; the end of the last picture
};

}  // namespace

std::unique_ptr<MovingPicture> BeginWebp(const Format& format) {
  return std::make_unique<WebpPicture>(format);
}

}  // namespace assay::film
