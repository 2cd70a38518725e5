#pragma once

// What most files include (ASSAY_PRECOMPILED_HEADERS).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#if __has_include(<Eigen/Geometry>)
#include <Eigen/Geometry>
#endif
