#include <dlfcn.h>
#include <link.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "files/image_module.h"
#include "numeric/check.h"
#include "numeric/text.h"

namespace etalon {
namespace {

// The folders in which the loader looks for libraries of the program or shared library that holds this code,
// its run path first.
std::vector<std::filesystem::path> libraryFolders(const link_map& holder) {
    const char* const name = holder.l_name[0] != '\0' ? holder.l_name : nullptr;
    const std::unique_ptr<void, int (*)(void*)> handle(dlopen(name, RTLD_LAZY | RTLD_NOLOAD), dlclose);
    Dl_serinfo size{};
    if (!handle || dlinfo(handle.get(), RTLD_DI_SERINFOSIZE, &size) != 0) return {};
    // The answer ends in an array and in the text to which that points.
    std::vector<Dl_serinfo> memory(size.dls_size / sizeof(Dl_serinfo) + 1);
    memory[0] = size;
    if (dlinfo(handle.get(), RTLD_DI_SERINFO, memory.data()) != 0) return {};
    std::vector<std::filesystem::path> folders;
    const Dl_serpath* const paths = memory[0].dls_serpath;
    for (unsigned i = 0; i < size.dls_cnt; ++i) folders.emplace_back(paths[i].dls_name);
    return folders;
}

// Where the module may be. First: beside the program, as built and as installed. Then the run path, for
// programs elsewhere that are linked with etalon::ar. Not left to dlopen(), which under the sanitizers takes
// the run path of their library.
std::vector<std::filesystem::path> moduleFolders() {
    Dl_info info{};
    link_map* holder = nullptr;
    void* const here = reinterpret_cast<void*>(&imageModule);
    const bool known = dladdr1(here, &info, reinterpret_cast<void**>(&holder), RTLD_DL_LINKMAP) != 0;
    ETALON_CHECK(known && holder != nullptr, "code at {} that the loader does not know", here);
    std::error_code ignored;
    const std::filesystem::path file = holder->l_name[0] != '\0'
                                           ? std::filesystem::path(holder->l_name)
                                           : std::filesystem::read_symlink("/proc/self/exe", ignored);
    std::vector<std::filesystem::path> folders = {
        (file.parent_path() / ETALON_MODULE_FOLDER).lexically_normal()};
    for (const std::filesystem::path& folder : libraryFolders(*holder)) folders.push_back(folder);
    return folders;
}

const ImageModule& loadImageModule() {
    const std::vector<std::filesystem::path> folders = moduleFolders();
    std::filesystem::path path = folders[0] / kImageModuleFile;
    std::error_code ignored;
    for (size_t i = 1; i < folders.size() && !std::filesystem::exists(path, ignored); ++i)
        path = folders[i] / kImageModuleFile;
    if (!std::filesystem::exists(path, ignored)) {
        path = folders[0] / kImageModuleFile;
        throw InputError(formatText(
            "{}: no such module; images cannot be read or PNG files written without it", path.string()));
    }
    // Never closed: its libraries register what runs at the end of the process.
    void* const handle = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    void* const entry = handle != nullptr ? dlsym(handle, kImageModuleEntry) : nullptr;
    if (entry == nullptr) throw InputError(formatText("{}: cannot be loaded: {}", path.string(), dlerror()));
    return *reinterpret_cast<ImageModuleEntry*>(entry)();
}

}  // namespace

const ImageModule& imageModule() {
    static const ImageModule& module = loadImageModule();
    return module;
}

}  // namespace etalon
