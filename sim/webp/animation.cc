#include <webp/encode.h>
#include <webp/mux.h>

#include <memory>

#include "sim/film/webp_library.h"

namespace assay::webp {
namespace {

// The effort of compression, from 0 (quick) to 6 (small). With 4 a picture takes an eighth of the
// time in which it was drawn.
constexpr int kMethod = 4;
constexpr float kQuality = 75;  // of 100
// Each picture is stored as its difference from the picture before. These are the least and the
// greatest number of pictures between two whole pictures. Whole pictures remove the traces that
// differences leave.
constexpr int kLeastBetweenKeys = 20;
constexpr int kMostBetweenKeys = 40;

struct FreesPicture {
  void operator()(WebPPicture* picture) const {
    WebPPictureFree(picture);
    delete picture;
  }
};

class Encoder : public film::WebpEncoder {
 public:
  Encoder(int width, int height) {
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigInit(&config_) == 0) return;
    options.kmin = kLeastBetweenKeys;
    options.kmax = kMostBetweenKeys;
    config_.method = kMethod;
    config_.quality = kQuality;
    encoder_.reset(WebPAnimEncoderNew(width, height, &options));
  }

  bool works() const { return encoder_ != nullptr; }

  bool Add(const render::Image& image, int from) override {
    const std::unique_ptr<WebPPicture, FreesPicture> picture(new WebPPicture);
    if (WebPPictureInit(picture.get()) == 0) return false;
    picture->use_argb = 1;
    picture->width = image.width;
    picture->height = image.height;
    return WebPPictureImportRGB(picture.get(), image.rgb.data(), 3 * image.width) != 0 &&
           WebPAnimEncoderAdd(encoder_.get(), picture.get(), from, &config_) != 0;
  }

  std::vector<std::uint8_t> Finish(int end) override {
    WebPData data;
    WebPDataInit(&data);
    const bool assembled = WebPAnimEncoderAdd(encoder_.get(), nullptr, end, nullptr) != 0 &&
                           WebPAnimEncoderAssemble(encoder_.get(), &data) != 0;
    std::vector<std::uint8_t> bytes;
    if (assembled) bytes.assign(data.bytes, data.bytes + data.size);
    WebPDataClear(&data);
    return bytes;
  }

 private:
  struct DeletesEncoder {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
  };
  WebPConfig config_{};
  std::unique_ptr<WebPAnimEncoder, DeletesEncoder> encoder_;
};

class Library : public film::WebpLibrary {
 public:
  std::unique_ptr<film::WebpEncoder> Begin(int width, int height) const override {
    auto encoder = std::make_unique<Encoder>(width, height);
    if (!encoder->works()) return nullptr;
    return encoder;
  }
};

}  // namespace
}  // namespace assay::webp

// film::BeginWebp gets the library from the module by this function.
extern "C" const assay::film::WebpLibrary* AssayWebpLibrary() {
  static const assay::webp::Library library;
  return &library;
}
