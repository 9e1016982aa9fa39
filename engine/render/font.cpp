// The bytes of DejaVuSans.ttf (STAMPEDE_FONT_FILE, Debian's fonts-dejavu-core), read by the assembler at build time:
// a list of numbers in C++ would take the compiler seconds.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    ".global stampede_dejavu_sans\n"
    ".hidden stampede_dejavu_sans\n"
    "stampede_dejavu_sans:\n"
    ".incbin \"" STAMPEDE_FONT_FILE
    "\"\n"
    ".global stampede_dejavu_sans_end\n"
    ".hidden stampede_dejavu_sans_end\n"
    "stampede_dejavu_sans_end:\n"
    ".byte 0\n"
    ".popsection\n");
