#include "server/gzip.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

namespace qdot::server {
namespace {

std::string unzipped(const std::string& bytes, std::size_t size) {
  std::string text(size + 1, '\0');
  z_stream stream{};
  EXPECT_EQ(::inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(::inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  ::inflateEnd(&stream);
  return text;
}

TEST(Gzip, WhatComesOutIsWhatWentIn) {
  for (const std::size_t size : {0, 1, 100, 65536, 1000000}) {
    std::string text(size, 'x');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>((i * i * 2654435761U) >> 13);
    EXPECT_EQ(unzipped(gzipped(text), size), text) << size;
    EXPECT_EQ(gzipped(text), gzipped(text));
  }
}

TEST(Gzip, TheClientDecides) {
  for (const char* yes : {"gzip", "br, gzip", "GZIP;q=0.5", "*", "deflate;q=1, *;q=0.1", "x-gzip"})
    EXPECT_TRUE(accepts_gzip(yes)) << yes;
  for (const char* no : {"", "br", "gzip;q=0", "gzip; q=0.000", "*, gzip;q=0", "*;q=0", "gzippo", ",,;"})
    EXPECT_FALSE(accepts_gzip(no)) << no;
}

}  // namespace
}  // namespace qdot::server
