#include "sim/film/ffmpeg.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/input_files/input_error.h"

namespace assay::film {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> ArgumentsFor(const Format& format) {
  return {"ffmpeg", "-y", "-nostdin", "-loglevel", "error", "-f", "rawvideo", "-pixel_format",
          "rgb24", "-video_size", fmt::format("{}x{}", format.width, format.height), "-framerate",
          fmt::format("{}", format.pictures_per_second), "-i", "pipe:0",
          // The usual colour format needs an even width and height.
          "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
          "-f", "mp4", "file:" + format.file.string()};
}

// A running ffmpeg that reads pictures from a pipe.
class Mp4Picture : public MovingPicture {
 public:
  Mp4Picture(const fs::path& program, const Format& format)
      : file_(format.file), pictures_per_second_(format.pictures_per_second) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) Fail();
    to_ffmpeg_ = ends[1];
    const bool started = Start(program, ArgumentsFor(format), ends[0]);
    close(ends[0]);
    if (!started) Fail();
  }
  ~Mp4Picture() override { Wait(); }
  Mp4Picture(const Mp4Picture&) = delete;
  Mp4Picture& operator=(const Mp4Picture&) = delete;

  void Add(const render::Image& image, double duration) override {
    const long times = std::lround(duration * pictures_per_second_);
    for (long i = 0; i < times; ++i) Write(image.rgb);
  }

  void Finish() override {
    if (Wait() != 0) Fail();
  }

 private:
  // In a process group of its own, ffmpeg does not get Ctrl-C, and it ends when the pipe does.
  bool Start(const fs::path& program, std::vector<std::string> arguments, int input) {
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error =
        posix_spawn(&process_, program.c_str(), &actions, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) process_ = 0;
    return error == 0;
  }

  void Write(const std::vector<std::uint8_t>& bytes) {
    std::size_t written = 0;
    while (written < bytes.size()) {
      const ssize_t count = write(to_ffmpeg_, bytes.data() + written, bytes.size() - written);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) Fail();
      written += static_cast<std::size_t>(count);
    }
  }

  // Ends the pipe, and returns how ffmpeg ended: 0 if it succeeded.
  int Wait() {
    if (to_ffmpeg_ >= 0) close(std::exchange(to_ffmpeg_, -1));
    if (process_ == 0) return 0;
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
  }

  [[noreturn]] void Fail() {
    Wait();
    throw EnvironmentError(file_.string() + ": ffmpeg cannot make this film");
  }

  fs::path file_;
  double pictures_per_second_;
  int to_ffmpeg_ = -1;
  pid_t process_ = 0;
};

}  // namespace

fs::path FindFfmpeg() {
  const char* const folders = std::getenv("PATH");
  std::istringstream path(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(path, folder, ':');) {
    const fs::path program = fs::path(folder) / "ffmpeg";
    std::error_code error;
    if (fs::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

std::unique_ptr<MovingPicture> BeginMp4(const Format& format) {
  const fs::path program = FindFfmpeg();
  if (program.empty()) {
    throw EnvironmentError(format.file.string() +
                           ": films in the format MP4 need ffmpeg: apt-get install ffmpeg; files "
                           "that end with .webp need nothing");
  }
  return std::make_unique<Mp4Picture>(program, format);
}

}  // namespace assay::film
