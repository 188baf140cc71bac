// The VTK shim: a fm_chart through vtkChartXY into SVG. Axis ranges are pixels, so that VTK's plot
// transform is a pure translation: its SVG device stretches pens under any other.
#include "chart.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include <vtkAutoInit.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkRenderer.h>
#include <vtkSVGContextDevice2D.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkXMLDataElement.h>

VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingContextOpenGL2);
VTK_MODULE_INIT(vtkRenderingFreeType);

namespace
{

constexpr int DPI = 72; // a point is a pixel
constexpr float LEFT_PX = 74, TOP_PX = 62, BOTTOM_PX = 62, LEGEND_GAP_PX = 22, EDGE_PX = 14;
constexpr float LEGEND_SYMBOL_PX = 34, LEGEND_ROW_PX = 21;
constexpr int TEXT_PX = 12, SMALL_PX = 11, TITLE_PX = 15;
constexpr double MARKER_PX = 9, LINE_PX = 1.6;
const fm_colour INK = { 34, 34, 34 }, FAINT = { 96, 96, 96 };

float text_width(const char *text, int size_px)
{
    vtkNew<vtkTextProperty> property;
    property->SetFontFamilyToArial();
    property->SetFontSize(size_px);
    vtkTextRenderer::Metrics metrics;
    vtkTextRenderer *renderer = vtkTextRenderer::GetInstance();
    if (renderer == nullptr || !renderer->GetMetrics(property, vtkStdString(text), metrics, DPI))
        return 0;
    return static_cast<float>(metrics.BoundingBox[1] - metrics.BoundingBox[0] + 1);
}

void set_text(vtkTextProperty *property, int size_px, fm_colour colour)
{
    property->SetFontFamilyToArial();
    property->SetFontSize(size_px);
    property->SetBold(0);
    property->SetItalic(0);
    property->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
}

void draw_text(vtkContext2D *painter, float x, float y, const char *text, int size_px,
               fm_colour colour, fm_anchor anchor = FM_ANCHOR_START, bool upright = false)
{
    if (text[0] == '\0')
        return;
    vtkNew<vtkTextProperty> property;
    set_text(property, size_px, colour);
    const float shift = anchor == FM_ANCHOR_START    ? 0
                        : anchor == FM_ANCHOR_MIDDLE ? text_width(text, size_px) / 2
                                                     : text_width(text, size_px);
    if (upright)
        property->SetOrientation(90);
    painter->ApplyTextProp(property);
    painter->DrawString(upright ? x : x - shift, upright ? y - shift : y, text);
}

void set_pen(vtkContext2D *painter, fm_colour colour, double width, int line = vtkPen::SOLID_LINE)
{
    painter->GetPen()->SetColor(colour.r, colour.g, colour.b, 255);
    painter->GetPen()->SetWidth(static_cast<float>(width));
    painter->GetPen()->SetLineType(line);
}

void draw_polygon(vtkContext2D *painter, std::vector<float> &xy, fm_colour edge, double edge_px,
                  fm_colour fill)
{
    painter->GetBrush()->SetColor(fill.r, fill.g, fill.b, 255);
    painter->GetDevice()->DrawPolygon(xy.data(), static_cast<int>(xy.size() / 2));
    xy.push_back(xy[0]);
    xy.push_back(xy[1]);
    set_pen(painter, edge, edge_px);
    painter->GetDevice()->DrawPoly(xy.data(), static_cast<int>(xy.size() / 2));
}

// The outline of a marker around the origin, one unit from edge to edge.
std::vector<float> marker_outline(fm_marker marker)
{
    const float arm = 0.16f, reach = 0.55f;
    std::vector<float> plus = { -arm,  reach, arm,    reach, arm,    arm,    reach, arm,
                                reach, -arm,  arm,    -arm,  arm,    -reach, -arm,  -reach,
                                -arm,  -arm,  -reach, -arm,  -reach, arm,    -arm,  arm };
    std::vector<float> xy;
    switch (marker) {
    case FM_MARKER_SQUARE:
        return { -0.44f, -0.44f, 0.44f, -0.44f, 0.44f, 0.44f, -0.44f, 0.44f };
    case FM_MARKER_DIAMOND:
        return { 0, -0.62f, 0.62f, 0, 0, 0.62f, -0.62f, 0 };
    case FM_MARKER_PLUS:
        return plus;
    case FM_MARKER_CROSS:
        for (size_t i = 0; i < plus.size(); i += 2) {
            xy.push_back((plus[i] - plus[i + 1]) * 0.7071f);
            xy.push_back((plus[i] + plus[i + 1]) * 0.7071f);
        }
        return xy;
    case FM_MARKER_CIRCLE:
    case FM_MARKER_COUNT:
        break;
    }
    for (int i = 0; i < 32; i++) {
        const double angle = i * 2 * M_PI / 32;
        xy.push_back(static_cast<float>(0.5 * std::cos(angle)));
        xy.push_back(static_cast<float>(0.5 * std::sin(angle)));
    }
    return xy;
}

void draw_marker(vtkContext2D *painter, const fm_series &series, float x, float y, double size_px)
{
    std::vector<float> xy = marker_outline(series.marker);
    const float size = static_cast<float>(size_px > 0 ? size_px : MARKER_PX);
    for (size_t i = 0; i < xy.size(); i += 2) {
        xy[i] = x + xy[i] * size;
        xy[i + 1] = y + xy[i + 1] * size;
    }
    const fm_colour white = { 255, 255, 255 };
    // A white edge keeps overlapping markers apart; a hollow one needs its own colour there.
    draw_polygon(painter, xy, series.hollow ? series.colour : white, series.hollow ? 1.5 : 0.8,
                 series.hollow ? white : series.colour);
}

int pen_line(fm_stroke stroke)
{
    switch (stroke) {
    case FM_STROKE_NONE:
        return vtkPen::NO_PEN;
    case FM_STROKE_SOLID:
        return vtkPen::SOLID_LINE;
    case FM_STROKE_DASHED:
        return vtkPen::DASH_LINE;
    case FM_STROKE_DOTTED:
        return vtkPen::DOT_LINE;
    }
    return vtkPen::SOLID_LINE;
}

// Everything inside the axes, painted by one plot, in the chart's order.
class InkPlot : public vtkPlot
{
  public:
    static InkPlot *New();
    vtkTypeMacro(InkPlot, vtkPlot);
    const fm_chart *chart = nullptr;

    bool Paint(vtkContext2D *painter) override
    {
        paint_bin(painter);
        for (size_t i = 0; i < chart->bar_count; i++)
            paint_bar(painter, chart->bars[i]);
        for (size_t i = 0; i < chart->series_count; i++)
            paint_line(painter, chart->series[i]);
        for (size_t i = 0; i < chart->series_count; i++)
            paint_points(painter, chart->series[i]);
        return true;
    }
    void GetBounds(double bounds[4]) override
    {
        bounds[0] = bounds[2] = 0;
        bounds[1] = chart->x.length_px;
        bounds[3] = chart->y.length_px;
    }

  private:
    float px(double x) const
    {
        return static_cast<float>(axis_position(&chart->x, x));
    }
    float py(double y) const
    {
        return static_cast<float>(axis_position(&chart->y, y));
    }
    void paint_bin(vtkContext2D *painter) const
    {
        if (!(chart->x.zero_below > 0))
            return;
        float wall[] = { FM_AXIS_BIN_PX, 0, FM_AXIS_BIN_PX,
                         static_cast<float>(chart->y.length_px) };
        set_pen(painter, FAINT, 1, vtkPen::DOT_LINE);
        painter->GetDevice()->DrawLines(wall, 2);
    }
    void paint_bar(vtkContext2D *painter, const fm_bar &bar) const
    {
        std::vector<float> xy = { px(bar.x0), py(bar.y0), px(bar.x1), py(bar.y0),
                                  px(bar.x1), py(bar.y1), px(bar.x0), py(bar.y1) };
        draw_polygon(painter, xy, { 255, 255, 255 }, 0.5, bar.colour);
    }
    void paint_line(vtkContext2D *painter, const fm_series &series) const
    {
        if (series.stroke == FM_STROKE_NONE || series.point_count < 2)
            return;
        std::vector<float> xy;
        for (size_t i = 0; i < series.point_count; i++) {
            xy.push_back(px(series.points[i].x));
            xy.push_back(py(series.points[i].y));
        }
        set_pen(painter, series.colour, series.width_px > 0 ? series.width_px : LINE_PX,
                pen_line(series.stroke));
        painter->GetDevice()->DrawPoly(xy.data(), static_cast<int>(series.point_count));
    }
    void paint_points(vtkContext2D *painter, const fm_series &series) const
    {
        for (size_t i = 0; i < series.point_count; i++) {
            const fm_point &point = series.points[i];
            if (std::isfinite(point.low) && std::isfinite(point.high) && point.low < point.high)
                paint_interval(painter, series.colour, point);
        }
        for (size_t i = 0; i < series.point_count && series.has_marker; i++)
            draw_marker(painter, series, px(series.points[i].x), py(series.points[i].y),
                        series.points[i].size_px);
    }
    void paint_interval(vtkContext2D *painter, fm_colour colour, const fm_point &point) const
    {
        const float cap = 4, x = px(point.x), low = py(point.low), high = py(point.high);
        float lines[] = {
            x, low, x, high, x - cap, low, x + cap, low, x - cap, high, x + cap, high
        };
        set_pen(painter, colour, 1.2);
        painter->GetDevice()->DrawLines(lines, 6);
    }
};
vtkStandardNewMacro(InkPlot);

// Titles, the legend outside on the right, and free labels.
class FrameItem : public vtkContextItem
{
  public:
    static FrameItem *New();
    vtkTypeMacro(FrameItem, vtkContextItem);
    const fm_chart *chart = nullptr;
    float left_px = 0, bottom_px = 0;

    bool Paint(vtkContext2D *painter) override
    {
        const float top = bottom_px + static_cast<float>(chart->y.length_px);
        draw_text(painter, EDGE_PX, top + 36, chart->title, TITLE_PX, INK);
        draw_text(painter, EDGE_PX, top + 16, chart->subtitle, TEXT_PX, FAINT);
        for (size_t i = 0; i < chart->label_count; i++) {
            const fm_label &label = chart->labels[i];
            draw_text(painter, left_px + static_cast<float>(label.x_px),
                      bottom_px + static_cast<float>(label.y_px), label.text,
                      label.size_px > 0 ? label.size_px : SMALL_PX, INK, label.anchor,
                      label.upright);
        }
        paint_legend(painter, left_px + static_cast<float>(chart->x.length_px) + LEGEND_GAP_PX,
                     top - LEGEND_ROW_PX / 2);
        return true;
    }

  private:
    void paint_legend(vtkContext2D *painter, float x, float y) const
    {
        for (size_t i = 0; i < chart->series_count; i++) {
            if (chart->series[i].label[0] == '\0')
                continue;
            paint_symbol(painter, chart->series[i], x, y);
            draw_text(painter, x + LEGEND_SYMBOL_PX, y - 4, chart->series[i].label, TEXT_PX, INK);
            y -= LEGEND_ROW_PX;
        }
        y -= LEGEND_ROW_PX / 2;
        for (int i = 0; i < FM_CHART_NOTES && chart->notes[i][0] != '\0'; i++) {
            draw_text(painter, x, y - 4, chart->notes[i], SMALL_PX, FAINT);
            y -= LEGEND_ROW_PX * 0.8f;
        }
    }
    void paint_symbol(vtkContext2D *painter, const fm_series &series, float x, float y) const
    {
        if (series.swatch) {
            std::vector<float> box = { x + 6, y - 6, x + 20, y - 6, x + 20, y + 6, x + 6, y + 6 };
            draw_polygon(painter, box, { 255, 255, 255 }, 0.5, series.colour);
            return;
        }
        if (series.stroke != FM_STROKE_NONE) {
            float line[] = { x, y, x + LEGEND_SYMBOL_PX - 8, y };
            set_pen(painter, series.colour, series.width_px > 0 ? series.width_px : LINE_PX,
                    pen_line(series.stroke));
            painter->GetDevice()->DrawLines(line, 2);
        }
        if (series.has_marker)
            draw_marker(painter, series, x + (LEGEND_SYMBOL_PX - 8) / 2, y, MARKER_PX);
    }
};
vtkStandardNewMacro(FrameItem);

float legend_width(const fm_chart *chart)
{
    float width = 0;
    for (size_t i = 0; i < chart->series_count; i++)
        if (chart->series[i].label[0] != '\0')
            width = std::max(width, LEGEND_SYMBOL_PX + text_width(chart->series[i].label, TEXT_PX));
    for (int i = 0; i < FM_CHART_NOTES && chart->notes[i][0] != '\0'; i++)
        width = std::max(width, text_width(chart->notes[i], SMALL_PX));
    return width > 0 ? width + LEGEND_GAP_PX : 0;
}

void set_axis(vtkAxis *axis, const fm_axis &data)
{
    vtkNew<vtkDoubleArray> positions;
    vtkNew<vtkStringArray> labels;
    for (size_t i = 0; i < data.tick_count; i++) {
        positions->InsertNextValue(axis_position(&data, data.ticks[i].value));
        labels->InsertNextValue(data.ticks[i].label);
    }
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(0, data.length_px);
    axis->SetCustomTickPositions(positions, labels);
    axis->SetTitle(data.title);
    axis->SetGridVisible(true);
    axis->GetGridPen()->SetColor(228, 228, 228, 255);
    axis->GetPen()->SetColor(INK.r, INK.g, INK.b, 255);
    set_text(axis->GetTitleProperties(), TEXT_PX, INK);
    set_text(axis->GetLabelProperties(), SMALL_PX, INK);
}

void build_chart(vtkChartXY *view, InkPlot *plot, const fm_chart *chart, float left, float bottom)
{
    plot->chart = chart;
    view->SetAutoAxes(false);
    view->SetAutoSize(false);
    view->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
    view->SetSize(vtkRectf(left, bottom, static_cast<float>(chart->x.length_px),
                           static_cast<float>(chart->y.length_px)));
    view->SetShowLegend(false);
    view->AddPlot(plot);
    set_axis(view->GetAxis(vtkAxis::BOTTOM), chart->x);
    set_axis(view->GetAxis(vtkAxis::LEFT), chart->y);
    view->GetAxis(vtkAxis::TOP)->SetVisible(false);
    view->GetAxis(vtkAxis::RIGHT)->SetVisible(false);
}

// Plots carry their clip on the element that is also transformed, which would shift the clip. All
// data lie inside the axes by construction, so no clip is needed; and with none there is no id in
// the file that could clash when several charts are put into one page. Lines without a pen are
// written as dashes of length 0, which show as dots.
void tidy(vtkXMLDataElement *element)
{
    element->RemoveAttribute("clip-path");
    for (int i = element->GetNumberOfNestedElements() - 1; i >= 0; i--) {
        vtkXMLDataElement *nested = element->GetNestedElement(i);
        const char *dash = nested->GetAttribute("stroke-dasharray");
        if (dash != nullptr && std::strcmp(dash, "0,10") == 0)
            element->RemoveNestedElement(nested);
        else
            tidy(nested);
    }
}

vtkSmartPointer<vtkXMLDataElement> child(vtkXMLDataElement *parent, const char *name,
                                         const char *text)
{
    auto element = vtkSmartPointer<vtkXMLDataElement>::New();
    element->SetName(name);
    if (text != nullptr)
        element->SetCharacterData(text, static_cast<int>(std::strlen(text)));
    parent->AddNestedElement(element);
    return element;
}

std::string draw(const fm_chart *chart)
{
    const float bottom = chart->bottom_px > 0 ? static_cast<float>(chart->bottom_px) : BOTTOM_PX;
    const float left = chart->left_px > 0 ? static_cast<float>(chart->left_px) : LEFT_PX;
    const float heading = 2 * EDGE_PX + std::max(text_width(chart->title, TITLE_PX),
                                                 text_width(chart->subtitle, TEXT_PX));
    const int width = static_cast<int>(std::max(
        heading, left + static_cast<float>(chart->x.length_px) + legend_width(chart) + EDGE_PX));
    const int height = static_cast<int>(bottom + static_cast<float>(chart->y.length_px) + TOP_PX);

    vtkNew<vtkGenericOpenGLRenderWindow> window; // gives the size; never rendered
    vtkNew<vtkRenderer> renderer;
    window->SetSize(width, height);
    window->SetDPI(DPI);
    window->AddRenderer(renderer);
    vtkNew<vtkContextScene> scene;
    scene->SetRenderer(renderer);
    scene->SetGeometry(width, height);
    vtkNew<vtkChartXY> view;
    vtkNew<InkPlot> plot;
    vtkNew<FrameItem> frame;
    build_chart(view, plot, chart, left, bottom);
    frame->chart = chart;
    frame->left_px = left;
    frame->bottom_px = bottom;
    scene->AddItem(view);
    scene->AddItem(frame);

    vtkNew<vtkXMLDataElement> root;
    root->SetName("svg");
    root->SetAttribute("xmlns", "http://www.w3.org/2000/svg");
    root->SetAttribute("version", "1.1");
    root->SetIntAttribute("width", width);
    root->SetIntAttribute("height", height);
    root->SetAttribute("viewBox",
                       ("0 0 " + std::to_string(width) + " " + std::to_string(height)).c_str());
    root->SetAttribute("role", "img");
    root->SetAttribute("fill", "none");
    root->SetAttribute("stroke", "none");
    child(root, "title", chart->title);
    child(root, "desc", chart->subtitle);
    auto paper = child(root, "rect", nullptr);
    paper->SetAttribute("width", "100%");
    paper->SetAttribute("height", "100%");
    paper->SetAttribute("fill", "#ffffff");
    vtkNew<vtkXMLDataElement> definitions; // clips only: dropped
    auto page = child(root, "g", nullptr);

    vtkNew<vtkSVGContextDevice2D> device;
    device->SetSVGContext(page, definitions);
    device->SetTextAsPath(true);
    vtkNew<vtkContext2D> painter;
    painter->Begin(device);
    device->Begin(renderer);
    scene->Paint(painter);
    device->End();
    painter->End();
    tidy(root);
    std::ostringstream out;
    out.imbue(std::locale::classic());
    root->PrintXML(out, vtkIndent());
    return out.str();
}

} // namespace

double chart_text_width_px(const char *text, int size_px)
{
    try {
        return text_width(text, size_px);
    } catch (const std::exception &) {
        return 0;
    }
}

fm_status chart_svg(char **svg, const fm_chart *chart, fm_error *err)
{
    *svg = nullptr;
    if (chart->failed)
        return fm_fail(err, FM_NO_MEMORY, "chart %s: out of memory", chart->title);
    try {
        *svg = strdup(draw(chart).c_str());
    } catch (const std::exception &problem) {
        return fm_fail(err, FM_INVALID, "chart %s: VTK: %s", chart->title, problem.what());
    }
    return *svg != nullptr ? FM_OK : fm_fail(err, FM_NO_MEMORY, "chart %s", chart->title);
}
