// Checkpoint files: a header that says what the state belongs to, a checksum, the state.
#pragma once

#include <cstdint>
#include <string>

namespace pssmlt {

// What a checkpoint belongs to; resuming on anything else is refused.
struct CheckpointIdentity {
  uint64_t scene = 0;     // text of the scene
  uint64_t settings = 0;  // command line, seed, images by path
  uint64_t plugins = 0;   // bytes of the plugin files in use and the program's version
};

// Replaces the file atomically: whoever is killed meanwhile finds the old one or the new one.
// Throws Failure (disk full, no permission).
void write_checkpoint(const std::string& path, const CheckpointIdentity& identity,
                      const std::string& state);
// The state. Throws Error with the reason if the file is not a checkpoint, is damaged, comes from
// another kind of machine, or belongs to something else.
std::string read_checkpoint(const std::string& path, const CheckpointIdentity& identity);
// Hash of the plugin files loaded so far (their contents, not where they lie) and the version.
uint64_t plugins_hash();
// 64-bit hash of bytes: a checksum, not a cryptographic one.
uint64_t hash_bytes(const void* data, size_t size, uint64_t start = 0);

}  // namespace pssmlt
