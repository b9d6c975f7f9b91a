/* report_template.h - the files the report's page is made of, as NUL-terminated text. */
#ifndef ECLAIRAGE_COMPARE_REPORT_TEMPLATE_H
#define ECLAIRAGE_COMPARE_REPORT_TEMPLATE_H

extern const char reportPage[];          /* report.html: the page with its fields, see report.c */
extern const char reportStyle[];         /* report.css */
extern const char reportPictureScript[]; /* report_picture.js; comes before reportScript */
extern const char reportScript[];        /* report.js */

#endif
