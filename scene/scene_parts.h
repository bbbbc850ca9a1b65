// The readers of the parts of a scene file. Each fills its part of the Scene and throws InputError for bad
// input.
#pragma once

#include "scene/scene.h"
#include "scene/toml_reader.h"

namespace etalon {

// What [0, 1] and other ranges are called in more than one part.
inline constexpr NumberRange kUnitRange{0, 1};
inline constexpr NumberRange kCoordinateRange{-kMaxSceneNumber, kMaxSceneNumber};
inline constexpr NumberRange kNonNegativeRange{0, kMaxSceneNumber};
inline constexpr NumberRange kPositiveRange{0, kMaxSceneNumber, true};
inline constexpr NumberRange kDegreesRange{-1e6, 1e6};
inline constexpr NumberRange kShadowBiasRange{-1e6, 1e6};
// Smallest magnitude of a scale factor.
inline constexpr double kMinScale = 1e-9;

Camera readCamera(const std::string& file, const TomlValue& value);
// The shadows of a light of this kind; the reader knows the tables shadowMap and planarShadow.
LightShadow readShadow(const TableReader& reader, LightKind kind);

Environment readEnvironment(const std::string& file, const TomlValue& value);
SceneLight readLight(const std::string& file, const TomlValue& value);
Output readOutput(const std::string& file, const TomlValue& value);
Render readRender(const std::string& file, const TomlValue& value);
Material readMaterial(const std::string& file, const std::string& name, const TomlValue& value);

// translate, rotate and scale keys, or `transform`, of a mesh or an instance; identity when there is none.
glm::dmat4 readTransform(const TableReader& reader);

// materials: those of the scene, for the names in `material`.
MeshObject readMesh(const std::string& file, const TomlValue& value, const std::vector<Material>& materials);
Plane readPlane(const std::string& file, const TomlValue& value, const std::vector<Material>& materials);

}  // namespace etalon
