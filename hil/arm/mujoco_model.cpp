#include "hil/arm/mujoco_model.hpp"

#include <cstring>
#include <memory>
#include <stdexcept>

namespace liana::bench {

MujocoModel::MujocoModel(const std::vector<std::string>& files) {
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  for (std::size_t i = 0; i < files.size(); ++i) {
    mj_makeEmptyFileVFS(vfs.get(), mjcf_name(i).c_str(), static_cast<int>(files[i].size()));
    std::memcpy(vfs->filedata[i], files[i].data(), files[i].size());
  }
  char error[500] = "";
  model = mj_loadXML(mjcf_name(0).c_str(), vfs.get(), error, sizeof error);
  mj_deleteVFS(vfs.get());
  if (model == nullptr)
    throw std::runtime_error(std::string("physics: MuJoCo refuses the model of robot and scene: ") + error);
  data = mj_makeData(model);
}

MujocoModel::~MujocoModel() {
  mj_deleteData(data);
  mj_deleteModel(model);
}

}  // namespace liana::bench
