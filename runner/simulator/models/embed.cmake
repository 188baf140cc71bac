# embed.cmake: -DINPUT= -DOUTPUT= -DNAME=: a file as a C array NAME and its length NAME_bytes.
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
file(WRITE ${OUTPUT} "#include <stddef.h>\nextern const unsigned char ${NAME}[];\n"
  "extern const size_t ${NAME}_bytes;\nconst unsigned char ${NAME}[] = { ${bytes} };\n"
  "const size_t ${NAME}_bytes = sizeof ${NAME};\n")
