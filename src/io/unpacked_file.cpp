// SPDX-License-Identifier: BSD-3-Clause
#include "io/unpacked_file.h"

#include "common/numbers.h"
#include "io/files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <unistd.h>
#include <zlib.h>
#ifdef PCL_UVOL_HAS_BZIP2
#include <bzlib.h>
#endif
#ifdef PCL_UVOL_HAS_ZSTD
#include <zstd.h>
#endif
#ifdef PCL_UVOL_HAS_XZ
#include <lzma.h>
#endif

namespace pcl_uvol {
namespace io {
namespace {

constexpr std::size_t block_bytes = std::size_t(1) << 16;

/** The next bytes of a descriptor; 0 at its end. */
std::size_t
readSome(const std::string& path, int from, char* bytes, std::size_t most)
{
  while (true) {
    const ssize_t got = ::read(from, bytes, most);
    if (got >= 0)
      return static_cast<std::size_t>(got);
    if (errno != EINTR)
      throwUnreadable(path, systemError());
  }
}

void
writeAll(const std::string& path, int to, const char* bytes, std::size_t count)
{
  while (count > 0) {
    const ssize_t done = ::write(to, bytes, count);
    if (done < 0 && errno == EINTR)
      continue;
    if (done < 0)
      throwUnreadable(path, {"not_unpacked", std::strerror(errno)});
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
}

[[noreturn]] void
throwDamaged(const std::string& path)
{
  throwUnreadable(path, "damaged_compression");
}

/** Gives packed bytes, and takes unpacked ones. */
struct Pipe {
  const std::string& path;
  std::function<std::size_t(char* bytes, std::size_t most)> read;
  int to;
  std::vector<char> in = std::vector<char>(block_bytes),
                    out = std::vector<char>(block_bytes);
};

/** \param window_bits as inflateInit2() takes them
 * \return bytes written */
std::uint64_t
inflateAll(Pipe& pipe, int window_bits)
{
  z_stream stream{};
  if (inflateInit2(&stream, window_bits) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  std::uint64_t written = 0;
  bool is_done = false;
  while (const std::size_t got = pipe.read(pipe.in.data(), pipe.in.size())) {
    stream.next_in = reinterpret_cast<Bytef*>(pipe.in.data());
    stream.avail_in = static_cast<uInt>(got);
    do {
      stream.next_out = reinterpret_cast<Bytef*>(pipe.out.data());
      stream.avail_out = static_cast<uInt>(pipe.out.size());
      if (is_done)
        inflateReset(&stream); // files of gzip may be joined
      const int state = inflate(&stream, Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
        throwDamaged(pipe.path);
      is_done = state == Z_STREAM_END;
      const std::size_t bytes = pipe.out.size() - stream.avail_out;
      writeAll(pipe.path, pipe.to, pipe.out.data(), bytes);
      written += bytes;
    } while (stream.avail_in > 0 || stream.avail_out == 0);
  }
  if (!is_done)
    throwDamaged(pipe.path);
  return written;
}

#ifdef PCL_UVOL_HAS_BZIP2
void
bunzipAll(Pipe& pipe)
{
  bz_stream stream{};
  bool is_open = false, is_done = false;
  const auto close = [&](bz_stream* held) {
    if (is_open)
      BZ2_bzDecompressEnd(held);
  };
  const std::unique_ptr<bz_stream, decltype(close)> end(&stream, close);
  while (const std::size_t got = pipe.read(pipe.in.data(), pipe.in.size())) {
    stream.next_in = pipe.in.data();
    stream.avail_in = static_cast<unsigned>(got);
    do {
      if (!is_open) { // files may be joined
        char* const next = stream.next_in;
        const unsigned left = stream.avail_in;
        stream = {};
        if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK)
          throw std::bad_alloc();
        is_open = true;
        stream.next_in = next;
        stream.avail_in = left;
      }
      stream.next_out = pipe.out.data();
      stream.avail_out = static_cast<unsigned>(pipe.out.size());
      const int state = BZ2_bzDecompress(&stream);
      if (state != BZ_OK && state != BZ_STREAM_END)
        throwDamaged(pipe.path);
      is_done = state == BZ_STREAM_END;
      writeAll(pipe.path, pipe.to, pipe.out.data(), pipe.out.size() - stream.avail_out);
      if (is_done) {
        BZ2_bzDecompressEnd(&stream);
        is_open = false;
      }
    } while (stream.avail_in > 0 || (is_open && stream.avail_out == 0));
  }
  if (!is_done)
    throwDamaged(pipe.path);
}
#endif

#ifdef PCL_UVOL_HAS_ZSTD
void
unzstdAll(Pipe& pipe)
{
  const std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream(
      ZSTD_createDStream(), ZSTD_freeDStream);
  if (!stream)
    throw std::bad_alloc();
  std::size_t left = 1;
  while (const std::size_t got = pipe.read(pipe.in.data(), pipe.in.size())) {
    ZSTD_inBuffer in{pipe.in.data(), got, 0};
    ZSTD_outBuffer out{};
    do {
      out = {pipe.out.data(), pipe.out.size(), 0};
      left = ZSTD_decompressStream(stream.get(), &out, &in);
      if (ZSTD_isError(left))
        throwDamaged(pipe.path);
      writeAll(pipe.path, pipe.to, pipe.out.data(), out.pos);
    } while (in.pos < in.size || out.pos == out.size);
  }
  if (left != 0)
    throwDamaged(pipe.path);
}
#endif

#ifdef PCL_UVOL_HAS_XZ
void
unxzAll(Pipe& pipe)
{
  lzma_stream stream = LZMA_STREAM_INIT;
  const std::unique_ptr<lzma_stream, void (*)(lzma_stream*)> end(&stream, lzma_end);
  constexpr std::uint64_t most_memory = std::uint64_t(1) << 30; // xz -9 takes 65 MB
  if (lzma_stream_decoder(&stream, most_memory, LZMA_CONCATENATED) != LZMA_OK)
    throw std::bad_alloc();
  lzma_ret state = LZMA_OK;
  while (state != LZMA_STREAM_END) {
    const std::size_t got = pipe.read(pipe.in.data(), pipe.in.size());
    stream.next_in = reinterpret_cast<const std::uint8_t*>(pipe.in.data());
    stream.avail_in = got;
    do {
      stream.next_out = reinterpret_cast<std::uint8_t*>(pipe.out.data());
      stream.avail_out = pipe.out.size();
      state = lzma_code(&stream, got > 0 ? LZMA_RUN : LZMA_FINISH);
      if (state == LZMA_MEM_ERROR)
        throw std::bad_alloc();
      if (state != LZMA_OK && state != LZMA_STREAM_END)
        throwDamaged(pipe.path);
      writeAll(pipe.path, pipe.to, pipe.out.data(), pipe.out.size() - stream.avail_out);
    } while (state == LZMA_OK && (stream.avail_in > 0 || stream.avail_out == 0));
  }
}
#endif

std::string
getPacking(const std::string& path)
{
  return lowerCase(std::filesystem::path(path).extension().string());
}

} // namespace

bool
isPacked(const std::string& path)
{
  const std::string packing = getPacking(path);
  return packing == ".gz" || packing == ".bz2" || packing == ".zst" || packing == ".xz";
}

bool
isPackedInside(const std::string& path, int file)
{
  const std::string ending = getPacking(path);
  std::array<unsigned char, 2> head{};
  return (ending == ".bgeo" || ending == ".bhclassic") &&
         ::pread(file, head.data(), head.size(), 0) ==
             static_cast<ssize_t>(head.size()) &&
         head[0] == 0x1f && head[1] == 0x8b;
}

std::string
withoutPacking(const std::string& path)
{
  return isPacked(path) ? std::filesystem::path(path).replace_extension().string()
                        : path;
}

std::string
temporaryFolder()
{
  const char* const named = std::getenv("TMPDIR");
  return named && *named ? named : "/tmp";
}

int
openTemporary(const std::string& path)
{
  const std::string folder = temporaryFolder();
  int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    std::string name = folder + "/pcl_uvol_XXXXXX";
    descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor >= 0)
      ::unlink(name.c_str());
  }
  if (descriptor < 0)
    throwUnreadable(path, {"no_temporary_file", folder, std::strerror(errno)});
  return descriptor;
}

int
unpackFile(const std::string& path, int packed)
{
  Descriptor to(openTemporary(path));
  Pipe pipe{path,
            [&](char* bytes, std::size_t most) {
              return readSome(path, packed, bytes, most);
            },
            to.get()};
  const std::string packing = getPacking(path);
  if (packing == ".gz" || !isPacked(path))
    inflateAll(pipe, MAX_WBITS + 16);
#ifdef PCL_UVOL_HAS_BZIP2
  else if (packing == ".bz2")
    bunzipAll(pipe);
#endif
#ifdef PCL_UVOL_HAS_ZSTD
  else if (packing == ".zst")
    unzstdAll(pipe);
#endif
#ifdef PCL_UVOL_HAS_XZ
  else if (packing == ".xz")
    unxzAll(pipe);
#endif
  else
    throwUnreadable(path, {"library_missing", packing, true});
  return to.take();
}

int
openStandardInput()
{
  // Standard input is there once per process, and so is what it gave.
  static std::mutex mutex;
  static int spooled = -1;
  const std::lock_guard<std::mutex> lock(mutex);
  if (spooled < 0) {
    Descriptor to(openTemporary("-"));
    std::vector<char> block(block_bytes);
    while (const std::size_t got =
               readSome("-", STDIN_FILENO, block.data(), block.size()))
      writeAll("-", to.get(), block.data(), got);
    spooled = to.take();
  }
  const int copy = ::fcntl(spooled, F_DUPFD_CLOEXEC, 0);
  if (copy < 0)
    throwUnreadable("-", systemError());
  return copy;
}

int
inflatePart(const std::string& path,
            int file,
            std::uint64_t offset,
            std::uint64_t packed,
            std::uint64_t bytes)
{
  Descriptor to(openTemporary(path));
  Pipe pipe{path,
            [&](char* block, std::size_t most) {
              const ssize_t got = ::pread(
                  file,
                  block,
                  static_cast<std::size_t>(std::min<std::uint64_t>(most, packed)),
                  static_cast<off_t>(offset));
              if (got < 0)
                throwUnreadable(path, systemError());
              offset += static_cast<std::uint64_t>(got);
              packed -= static_cast<std::uint64_t>(got);
              return static_cast<std::size_t>(got);
            },
            to.get()};
  if (inflateAll(pipe, -MAX_WBITS) != bytes)
    throwDamaged(path);
  return to.take();
}

} // namespace io
} // namespace pcl_uvol
