#include "sim/film/shoot.h"

#include <future>
#include <utility>

#include "sim/film/ffmpeg.h"
#include "sim/film/webp.h"

namespace assay::film {

bool IsMovingPicture(const std::filesystem::path& file) {
  return file.extension() == ".webp" || file.extension() == ".mp4";
}

std::unique_ptr<MovingPicture> Begin(const Format& format) {
  return format.file.extension() == ".mp4" ? BeginMp4(format) : BeginWebp(format);
}

int Shoot(Film& film, MovingPicture& file, const std::function<bool(int)>& after) {
  std::future<void> encoding;
  const auto wait = [&encoding] {
    if (encoding.valid()) encoding.get();
  };
  int drawn = 0;
  bool goes_on = true;
  while (goes_on && drawn < film.size()) {
    render::Image image = film.Draw(drawn);
    const double duration = film.Duration(drawn);
    wait();
    encoding = std::async(std::launch::async, [&file, duration, picture = std::move(image)] {
      file.Add(picture, duration);
    });
    goes_on = after(++drawn);
  }
  wait();
  file.Finish();
  return drawn;
}

}  // namespace assay::film
