# fragmark_add_method(ID SOURCE): builds the method plugin METHODS/ID/ID.so, puts the GLSL files that
# lie beside SOURCE next to it (as links: an edited shader needs no build), and installs both to
# lib/fragmark/methods/ID. METHODS is ${CMAKE_BINARY_DIR}/methods of the project that calls it:
# what `fragmark --plugin-dir` and FRAGMARK_PLUGIN_PATH take. The target is method-ID.
function(fragmark_add_method id source)
  get_filename_component(source ${source} ABSOLUTE)
  get_filename_component(folder ${source} DIRECTORY)
  set(built ${CMAKE_BINARY_DIR}/methods/${id})
  set(installed lib/fragmark/methods/${id})

  add_library(method-${id} MODULE ${source})
  target_link_libraries(method-${id} PRIVATE fragmark::plugin)
  set_target_properties(method-${id} PROPERTIES PREFIX "" OUTPUT_NAME ${id} SUFFIX .so
    C_STANDARD 11 C_VISIBILITY_PRESET hidden LIBRARY_OUTPUT_DIRECTORY ${built})

  file(GLOB shaders CONFIGURE_DEPENDS ${folder}/*.glsl)
  foreach(shader IN LISTS shaders)
    get_filename_component(name ${shader} NAME)
    file(MAKE_DIRECTORY ${built})
    file(CREATE_LINK ${shader} ${built}/${name} SYMBOLIC)
  endforeach()
  install(TARGETS method-${id} LIBRARY DESTINATION ${installed})
  install(FILES ${shaders} DESTINATION ${installed})
endfunction()
