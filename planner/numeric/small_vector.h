#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

namespace assay::numeric {

// A vector of any size for Eigen. It allocates memory only if it is longer than a pose and a few
// tolerances. Searches make many of these vectors, and each lives for a short time.
class SmallVector : public Eigen::Map<Eigen::VectorXd> {
 public:
  SmallVector() : Map(nullptr, 0) {}
  explicit SmallVector(Eigen::Index size) : Map(nullptr, 0) { resize(size); }
  SmallVector(const SmallVector& other) : Map(nullptr, 0) { *this = other; }
  SmallVector(SmallVector&& other) noexcept : Map(nullptr, 0) { Take(other); }
  template <class Expression>
  SmallVector(const Eigen::MatrixBase<Expression>& other) : Map(nullptr, 0) {
    *this = other;
  }
  ~SmallVector() = default;

  SmallVector& operator=(const SmallVector& other) {
    if (this == &other) return *this;
    resize(other.size());
    Map::operator=(other);
    return *this;
  }
  SmallVector& operator=(SmallVector&& other) noexcept {
    if (this != &other) Take(other);
    return *this;
  }
  template <class Expression>
  SmallVector& operator=(const Eigen::MatrixBase<Expression>& other) {
    if (other.size() != size()) {
      resize(other.size());
      noalias() = other;
    } else {
      Map::operator=(other);
    }
    return *this;
  }

  // Changes the size. The content is lost if the size differs.
  void resize(Eigen::Index size) {
    if (size == this->size()) return;
    large_ = size > kSmall ? std::make_unique<double[]>(static_cast<std::size_t>(size)) : nullptr;
    Point(size);
  }

 private:
  static constexpr Eigen::Index kSmall = 8;

  void Point(Eigen::Index size) {
    new (static_cast<Map*>(this)) Map(large_ ? large_.get() : small_.data(), size);
  }

  void Take(SmallVector& other) {
    if (other.large_ == nullptr) {
      small_ = other.small_;
      large_ = nullptr;
    } else {
      large_ = std::move(other.large_);
    }
    Point(other.size());
    other.large_ = nullptr;
    other.Point(0);
  }

  std::array<double, kSmall> small_;
  std::unique_ptr<double[]> large_;
};

}  // namespace assay::numeric
