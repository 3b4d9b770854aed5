#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

namespace snapspace {

namespace nb = nanobind;

// Python validates shapes and values on input (snapspace/*). Only sizes and indices that could read
// beyond an array are checked again here.
using VectorIn = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using MatrixIn = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using TensorIn = nb::ndarray<const double, nb::ndim<3>, nb::c_contig, nb::device::cpu>;
using SingleVectorIn = nb::ndarray<const float, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using SingleMatrixIn = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using SingleTensorIn = nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>;
using IndexMatrixIn = nb::ndarray<const std::int32_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using IndexVectorIn = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using DoublesOut = nb::ndarray<nb::numpy, double>;
using IndicesOut = nb::ndarray<nb::numpy, std::int32_t>;

inline void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

inline void require_below(const IndexMatrixIn& indices, std::size_t n, const char* message) {
  for (std::size_t i = 0; i < indices.size(); ++i)
    require(indices.data()[i] >= 0 && static_cast<std::size_t>(indices.data()[i]) < n, message);
}

/// A new NumPy array that owns its memory.
template <class T>
nb::ndarray<nb::numpy, T> new_array(std::initializer_list<std::size_t> shape) {
  std::size_t count = 1;
  for (const std::size_t extent : shape) count *= extent;
  T* data = new T[count];
  nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<T*>(p); });
  return nb::ndarray<nb::numpy, T>(data, shape, owner);
}

template <class T>
nb::ndarray<nb::numpy, T> copy_to_array(const T* from, std::initializer_list<std::size_t> shape) {
  nb::ndarray<nb::numpy, T> result = new_array<T>(shape);
  std::copy_n(from, result.size(), result.data());
  return result;
}

}  // namespace snapspace
