#include "hil/arm/mujoco_model.hpp"

#include <cstring>
#include <memory>
#include <stdexcept>

namespace liana::bench {

MujocoModel::MujocoModel(const std::string& xml) {
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  mj_makeEmptyFileVFS(vfs.get(), "arm.xml", static_cast<int>(xml.size()));
  std::memcpy(vfs->filedata[0], xml.data(), xml.size());
  char error[500] = "";
  model = mj_loadXML("arm.xml", vfs.get(), error, sizeof error);
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
