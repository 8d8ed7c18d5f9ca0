/* The locale of the environment, as programs set it that carry others: to be preloaded. It must have a decimal comma. */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

__attribute__((constructor)) static void take_locale(void)
{
   char text[8];
   setlocale(LC_ALL, "");
   snprintf(text, sizeof text, "%.1f", 0.5);
   if (text[1] != ',') abort();
}
