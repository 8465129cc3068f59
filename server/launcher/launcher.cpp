// The program `qdot` of a bundle (server/bundle): starts lib/qdot beside it with the bundle's own loader and
// libraries, so that nothing of the machine is used but its kernel. It is linked statically for the same
// reason.
//
// It finds itself by /proc, and where that is not mounted by the path that the kernel was given
// (getauxval(3), AT_EXECFN). Source of the loader's options: ld.so(8).

#include <sys/auxv.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

constexpr int cannot_start = 127;  // as a shell says it

std::string resolved(const char* path) {
  char* real = ::realpath(path, nullptr);
  std::string text = real == nullptr ? "" : real;
  std::free(real);
  return text;
}

/// The directory of this file, its symbolic links followed; empty where it cannot be found.
std::string own_directory() {
  std::string self = resolved("/proc/self/exe");
  const auto executed = ::getauxval(AT_EXECFN);
  if (self.empty() && executed != 0) self = resolved(reinterpret_cast<const char*>(executed));
  const std::size_t slash = self.rfind('/');
  return slash == std::string::npos ? "" : self.substr(0, slash);
}

/// Without what would make the loader take other libraries in: those of the machine belong to another libc.
std::vector<char*> environment_for_the_loader(char** environment) {
  std::vector<char*> kept;
  for (; *environment != nullptr; ++environment) {
    if (std::strncmp(*environment, "LD_", 3) != 0) kept.push_back(*environment);
  }
  kept.push_back(nullptr);
  return kept;
}

int complain(const std::string& why) {
  std::fprintf(stderr, "qdot: %s\n", why.c_str());
  return cannot_start;
}

}  // namespace

int main(int argc, char** argv, char** environment) {
  const std::string directory = own_directory();
  if (directory.empty()) return complain("this program cannot find its own directory; call it by its path");
  if (directory.find_first_of(":;$") != std::string::npos)
    return complain("the loader cannot read a directory with : ; or $ in its name: " + directory);
  std::string libraries = directory + "/lib";
#ifdef __aarch64__
  std::string loader = libraries + "/ld-linux-aarch64.so.1";
#else
  std::string loader = libraries + "/ld-linux-x86-64.so.2";
#endif
  std::string program = libraries + "/qdot";
  char library_path[] = "--library-path", no_cache[] = "--inhibit-cache", name_option[] = "--argv0",
       name[] = "qdot";
  std::vector<char*> words{loader.data(), no_cache, library_path,  libraries.data(),
                           name_option,   name,     program.data()};
  words.insert(words.end(), argv + (argc > 0 ? 1 : 0), argv + argc);
  words.push_back(nullptr);
  ::execve(loader.c_str(), words.data(), environment_for_the_loader(environment).data());
  return complain(loader + ": " + std::strerror(errno));
}
