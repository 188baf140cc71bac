/* Words and looks that the kinds of a figure's charts share: titles of axes, names below the plot,
 * the style of a method's series. */
#ifndef FM_FIGURE_LABELS_H
#define FM_FIGURE_LABELS_H

#include "figure_values.h"

/* Colour, marker and dash of a method. */
void figure_style_series(fm_series *series, const fm_method_info *look);
/* Of the scene at that place, from 1 on, without its folder. */
const char *figure_scene_name(const fm_figure_job *job, size_t place);
/* A name below the plot, read from below; returns how far it reaches, px. */
size_t figure_add_upright(fm_chart *chart, double x_px, const char *text);

/* "frame time [ms]": of a column. */
void figure_title_column(char title[128], const char *column);
/* The same of the sum of metrics, after the first of them. */
void figure_title_quantity(char title[128], const fm_text_list *metrics);
/* "y / that of ratio_to's method" */
void figure_title_ratio(char title[128], const fm_figure_job *job);

#endif
