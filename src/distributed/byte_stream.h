// SPDX-License-Identifier: BSD-3-Clause
// Plain values in messages between processes of one machine type.
#pragma once

#include <pcl_uvol/distributed/communicator.h>

#include <cstring>
#include <type_traits>
#include <vector>

namespace pcl_uvol {

/** \brief Appends values to a message. */
class ByteWriter {
public:
  explicit ByteWriter(Bytes& bytes)
      : bytes_(bytes)
  {
  }

  template <typename T>
  void
  put(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof(T));
  }

  /** \brief Their number, then the values. @{ */
  template <typename T>
  void
  put(const T* values, std::size_t count)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    put(count);
    append(values, count * sizeof(T));
  }
  template <typename T>
  void
  put(const std::vector<T>& values)
  {
    put(values.data(), values.size());
  }
  /** @} */

private:
  void
  append(const void* data, std::size_t size)
  {
    const auto* const first = static_cast<const std::uint8_t*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  Bytes& bytes_;
};

/** \brief Reads back what a ByteWriter wrote. */
class ByteReader {
public:
  /** \param bytes must outlive the reader */
  explicit ByteReader(const Bytes& bytes)
      : bytes_(bytes)
  {
  }

  bool
  atEnd() const
  {
    return next_ == bytes_.size();
  }

  template <typename T>
  T
  get()
  {
    T value;
    take(&value, sizeof(T));
    return value;
  }

  /** \brief Append the values to others. */
  template <typename T>
  void
  get(std::vector<T>& values)
  {
    const auto count = get<std::size_t>();
    const std::size_t old = values.size();
    values.resize(old + count);
    take(values.data() + old, count * sizeof(T));
  }

private:
  void
  take(void* data, std::size_t size)
  {
    if (size > 0)
      std::memcpy(data, bytes_.data() + next_, size);
    next_ += size;
  }

  const Bytes& bytes_;
  std::size_t next_ = 0;
};

/** \brief The items of all processes, one after the other. */
template <typename T>
std::vector<T>
allGatherItems(Communicator& communicator, const std::vector<T>& items)
{
  Bytes message;
  ByteWriter(message).put(items);
  std::vector<T> all;
  for (const Bytes& bytes : communicator.allGather(message))
    ByteReader(bytes).get(all);
  return all;
}

} // namespace pcl_uvol
