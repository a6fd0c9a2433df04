// Nothing loaded that a scene does not need: the libraries for images are not mapped while a scene
// without images renders.
#include <gtest/gtest.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace {

std::string maps_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/maps");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

pid_t start_render(const std::string& output) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  const std::string scene = std::string(PSSMLT_SOURCE_DIR) + "/scenes/cornell-box.txt";
  execl(PSSMLT_BINARY, PSSMLT_BINARY, scene.c_str(), "-o", output.c_str(), "--quiet", "--time",
        "300s", "--spp", "1000000", static_cast<char*>(nullptr));
  _exit(127);
}

TEST(Startup, ImageLibrariesAreNotMappedWhileRendering) {
  const auto folder = std::filesystem::temp_directory_path();
  const std::string output =
      (folder / ("pssmlt-startup-" + std::to_string(getpid()) + ".exr")).string();
  const pid_t pid = start_render(output);
  ASSERT_GT(pid, 0);
  // The integrator's plugin is mapped when the scene has been built; then rendering starts.
  std::string maps;
  for (int i = 0; i < 600; ++i) {
    maps = maps_of(pid);
    if (maps.find("/integrator/path.so") != std::string::npos) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  maps = maps_of(pid);
  kill(pid, SIGKILL);
  int status = 0;
  waitpid(pid, &status, 0);
  std::filesystem::remove(output);
  EXPECT_NE(maps.find("/integrator/path.so"), std::string::npos) << "the render did not start";
  EXPECT_NE(maps.find("libembree"), std::string::npos);
  for (const char* library : {"libOpenImageIO", "libOpenColorIO", "libtinygltf", "/gltf.so",
                              "/import_gltf.so", "libdraco", "libcpp-httplib", "/live_server.so",
                              "/image_io.so", "/display.so", "/imagemap.so", "/bdpt.so"}) {
    EXPECT_EQ(maps.find(library), std::string::npos) << library << " is mapped";
  }
}

}  // namespace
