#include "ui/damage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include "ui/theme.h"

namespace lueur {
namespace {

template <typename Saved, typename Given>
bool same_bytes(const Saved& saved, const Given& given) {
    return saved.size() == static_cast<std::size_t>(given.Size) &&
           (saved.empty() || std::memcmp(saved.data(), given.Data, saved.size() * sizeof(saved[0])) == 0);
}

// The pixels that a command may touch, exactly as ImGui's OpenGL backend rounds them for glScissor.
PixelBox scissor_of(const ImDrawCmd& command, int height) {
    const auto& clip = command.ClipRect;
    if (clip.z <= clip.x || clip.w <= clip.y) return {};
    const int left = static_cast<int>(clip.x), below = static_cast<int>(static_cast<float>(height) - clip.w);
    const int wide = static_cast<int>(clip.z - clip.x), high = static_cast<int>(clip.w - clip.y);
    return {left, height - below - high, left + wide, height - below};
}

// Around the triangles of a list, within their scissors.
PixelBox box_of(const ImDrawList& list, int height) {
    PixelBox box;
    for (const auto& command : list.CmdBuffer) {
        const auto clip = scissor_of(command, height);
        if (clip.empty() || command.ElemCount == 0) continue;
        ImVec2 low(1e6f, 1e6f), high(-1e6f, -1e6f);
        for (unsigned i = 0; i < command.ElemCount; ++i) {
            const auto index = command.VtxOffset + list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
            const auto& at = list.VtxBuffer[static_cast<int>(index)].pos;
            low = {std::min(low.x, at.x), std::min(low.y, at.y)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y)};
        }
        const auto pixel = [](float value) { return static_cast<int>(std::clamp(value, -1e6f, 1e6f)); };
        const PixelBox drawn{pixel(std::floor(low.x)), pixel(std::floor(low.y)), pixel(std::ceil(high.x)),
                             pixel(std::ceil(high.y))};
        const auto seen = intersection(clip, drawn);
        if (!seen.empty()) box = smallest_around(box, seen);
    }
    return box;
}

std::int64_t area(const PixelBox& box) {
    return box.empty() ? 0 : std::int64_t{box.right - box.left} * (box.bottom - box.top);
}

// Boxes that are cheaper drawn as one become one. Those that still overlap are drawn twice, with the same result.
void merge(std::vector<PixelBox>& boxes) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t k = i + 1; k < boxes.size();) {
            const auto both = smallest_around(boxes[i], boxes[k]);
            if (area(both) > area(boxes[i]) + area(boxes[k])) {
                ++k;
                continue;
            }
            boxes[i] = both;
            boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(k));
            k = i + 1; // the larger one may take in more
        }
}

bool in_pixels(const ImDrawData& data) {
    return data.FramebufferScale.x == 1 && data.FramebufferScale.y == 1 && data.DisplayPos.x == 0 &&
           data.DisplayPos.y == 0;
}

} // namespace

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
    return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

PixelBox smallest_around(const PixelBox& a, const PixelBox& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

PixelBox whole_frame(const ImDrawData& data) {
    return {0, 0, static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
            static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y)};
}

std::vector<PixelBox> FrameDamage::next(const ImDrawData& data, const PixelBox& picture) {
    const auto all = whole_frame(data);
    const bool comparable = known_ && all == all_ && in_pixels(data);
    const auto count = static_cast<std::size_t>(data.CmdListsCount);
    std::vector<PixelBox> boxes{picture, picture_}; // the second: where it was
    for (std::size_t i = count; i < lists_.size(); ++i) boxes.push_back(lists_[i].box);
    lists_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& now = *data.CmdLists[i];
        auto& list = lists_[i];
        const bool calls = std::ranges::any_of(now.CmdBuffer, [](const auto& c) { return c.UserCallback != nullptr; });
        if (!calls && comparable && same_bytes(list.vertices, now.VtxBuffer) &&
            same_bytes(list.indices, now.IdxBuffer) && same_bytes(list.commands, now.CmdBuffer))
            continue;
        boxes.push_back(list.box);
        list.vertices.assign(now.VtxBuffer.begin(), now.VtxBuffer.end());
        list.indices.assign(now.IdxBuffer.begin(), now.IdxBuffer.end());
        list.commands.assign(now.CmdBuffer.begin(), now.CmdBuffer.end());
        list.box = calls ? all : box_of(now, all.bottom);
        boxes.push_back(list.box);
    }
    all_ = all;
    picture_ = picture;
    known_ = true;
    if (!comparable) return {all};
    for (auto& box : boxes) box = intersection(box, all);
    std::erase_if(boxes, [](const PixelBox& box) { return box.empty(); });
    merge(boxes);
    return boxes;
}

void draw_box(ImDrawData& data, const PixelBox& box, const std::function<void()>& draw_picture) {
    const auto all = whole_frame(data);
    glViewport(0, 0, all.right, all.bottom);
    glScissor(box.left, all.bottom - box.bottom, box.right - box.left, box.bottom - box.top);
    glEnable(GL_SCISSOR_TEST);
    glClearColor(colours::panel.x, colours::panel.y, colours::panel.z,
                 1); // the panels' windows draw no ground of their own
    glClear(GL_COLOR_BUFFER_BIT);
    draw_picture();
    if (box == all) {
        ImGui_ImplOpenGL3_RenderDrawData(&data);
        return;
    }
    std::vector<ImDrawList*> lists;
    std::vector<ImVec4> clips;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        auto& list = *data.CmdLists[i];
        bool touched = false;
        for (auto& command : list.CmdBuffer) {
            clips.push_back(command.ClipRect);
            const auto part = intersection(scissor_of(command, all.bottom), box);
            touched = touched || !part.empty();
            command.ClipRect = {static_cast<float>(part.left), static_cast<float>(part.top),
                                static_cast<float>(part.right), static_cast<float>(part.bottom)};
        }
        if (touched) lists.push_back(&list);
    }
    ImDrawData part = data;
    part.CmdLists = lists.data();
    part.CmdListsCount = static_cast<int>(lists.size());
    if (!lists.empty()) ImGui_ImplOpenGL3_RenderDrawData(&part);
    auto clip = clips.begin();
    for (int i = 0; i < data.CmdListsCount; ++i)
        for (auto& command : data.CmdLists[i]->CmdBuffer) command.ClipRect = *clip++;
}

} // namespace lueur
